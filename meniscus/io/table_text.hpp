#pragma once

#include <string>
#include <string_view>

#include "meniscus/io/table.hpp"

namespace meniscus::io {

/// The table in a text that people wrote, as `read_commented_table` reads it from a file; `name`
/// stands in messages in the place of the file's.
[[nodiscard]] Table parse_commented_table(const std::string& name, std::string_view text);

}  // namespace meniscus::io
