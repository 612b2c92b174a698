#pragma once

#include <filesystem>

namespace meniscus {

/// Keeps other programs from writing a folder. The lock is the system's (`flock`): no file stands
/// for it, and it ends with its process, however that ends.
class FolderLock {
 public:
  /// Throws InvalidInput, with the process that holds it where the system tells, when the folder is
  /// locked or cannot be opened. File systems that know no locks give none.
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
