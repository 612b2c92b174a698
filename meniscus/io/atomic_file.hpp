#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace meniscus::io {

/// Writes `bytes` under a temporary name in the folder of `path`, syncs and renames. Whoever opens
/// `path` sees the old file or the new one, whole. A device is written in place. Throws RunFailure
/// with the path and the system's reason when the disk refuses; the temporary is removed then.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The bytes of a regular file. Throws InvalidInput with the path and the system's reason.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Throws RunFailure "PATH: cannot be written: REASON" for an error number of the system.
[[noreturn]] void fail_writing(const std::filesystem::path& path, int error_number);

}  // namespace meniscus::io
