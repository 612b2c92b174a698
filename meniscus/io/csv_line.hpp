#pragma once

#include <string>
#include <vector>

#include "meniscus/io/table.hpp"

namespace meniscus::io {

/// A row of a CSV file with its line break. Texts with a comma, quote or line break are quoted.
[[nodiscard]] std::string csv_line(const std::vector<Cell>& row);

}  // namespace meniscus::io
