#include "meniscus/report/value_range.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace meniscus::report {

ValueRange color_range(std::span<const double> values) {
  std::vector<double> sorted;
  std::ranges::copy_if(values, std::back_inserter(sorted),
                       [](double v) { return std::isfinite(v); });
  if (sorted.empty()) return {};
  std::ranges::sort(sorted);
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  ValueRange range{at(0.01), at(0.99)};
  // A sphere has one curvature: its roundoff must not fill the colour scale.
  const double least = std::max(0.02 * std::max(std::abs(range.low), std::abs(range.high)), 1e-12);
  if (range.high - range.low < least) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * least, middle + 0.5 * least};
  }
  return range;
}

}  // namespace meniscus::report
