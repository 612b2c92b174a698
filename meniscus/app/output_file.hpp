#pragma once

#include <filesystem>

namespace meniscus {

/// Throws InvalidInput naming option -o unless the file can be written. Its folder must exist and
/// be writable, and the name not be that of a folder.
void require_writable(const std::filesystem::path& file);

}  // namespace meniscus
