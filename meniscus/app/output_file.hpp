#pragma once

#include <filesystem>

namespace meniscus {

/// Throws InvalidInput naming option -o unless a file of that name can be made: its folder is there
/// and can be written to, and the name is not that of a folder.
void require_writable(const std::filesystem::path& file);

}  // namespace meniscus
