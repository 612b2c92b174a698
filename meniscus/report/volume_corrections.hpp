#pragma once

#include <optional>

#include "meniscus/io/table.hpp"

namespace meniscus::report {

/// Σ |volume_correction| over the steps of one drop, for the drop where the sum is largest [R0]. It
/// measures how far volumes were corrected; the drift only shows that they were. Step 0 does not
/// count: nothing has moved. None where the table lacks a column.
[[nodiscard]] std::optional<double> volume_correction_sum(const io::Table& drops);

}  // namespace meniscus::report
