#pragma once

#include <optional>

#include "meniscus/io/table.hpp"

namespace meniscus::report {

/// Σ |volume_correction| over the steps of the drop for which it is largest [R0], of a table of
/// drops: how far volumes were put right, where the drift shows only that they were. Step 0, where
/// nothing has moved, does not count. None where the table lacks a column.
[[nodiscard]] std::optional<double> volume_correction_sum(const io::Table& drops);

}  // namespace meniscus::report
