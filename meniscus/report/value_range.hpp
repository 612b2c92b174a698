#pragma once

#include <span>

namespace meniscus::report {

/// The range of values that a scale of colours shows.
struct ValueRange {
  double low = 0.0, high = 1.0;
};

/// The range from the 1st to the 99th percentile of the finite values, so that a few outliers do
/// not take the colours. Its width is at least a fiftieth of the values.
[[nodiscard]] ValueRange color_range(std::span<const double> values);

}  // namespace meniscus::report
