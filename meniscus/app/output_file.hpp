#pragma once

#include <filesystem>

namespace meniscus {

/// Throws InvalidInput naming option -o unless the file can be written: its folder exists and is
/// writable, and the name is not that of a folder.
void require_writable(const std::filesystem::path& file);

}  // namespace meniscus
