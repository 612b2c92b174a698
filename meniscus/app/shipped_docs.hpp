#pragma once

#include <filesystem>

namespace meniscus {

/// The folder of the pages, cases and studies that were installed with this program,
/// "/usr/share/doc/meniscus". It need not exist: a program in a build folder has none.
[[nodiscard]] std::filesystem::path shipped_docs();

}  // namespace meniscus
