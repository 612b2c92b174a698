#pragma once

#include <filesystem>

namespace meniscus {

/// Keeps other programs from writing to a folder. The lock is the system's (`flock`): it needs no
/// file, and the system releases it when the process ends.
class FolderLock {
 public:
  /// Throws InvalidInput when the folder is locked (naming the holder where known) or cannot be
  /// opened. On a file system without locks nothing is locked.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

}  // namespace meniscus
