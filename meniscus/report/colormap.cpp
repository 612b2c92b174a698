#include "meniscus/report/colormap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"

namespace meniscus::report {

Color viridis(double s) {
  // Ten equidistant colours of matplotlib's viridis (S. van der Walt and N. Smith, 2015; CC0).
  static constexpr std::array<std::array<int, 3>, 10> anchors = {{{68, 1, 84},
                                                                  {72, 40, 120},
                                                                  {62, 73, 137},
                                                                  {49, 104, 142},
                                                                  {38, 130, 142},
                                                                  {31, 158, 137},
                                                                  {53, 183, 121},
                                                                  {110, 206, 88},
                                                                  {181, 222, 43},
                                                                  {253, 231, 37}}};
  const double position = std::clamp(std::isfinite(s) ? s : 0.0, 0.0, 1.0) * (anchors.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(position), anchors.size() - 2);
  const double w = position - static_cast<double>(k);
  const auto part = [&](std::size_t i) {
    return ((1.0 - w) * anchors[k][i] + w * anchors[k + 1][i]) / 255.0;
  };
  return {part(0), part(1), part(2)};
}

Color shade(const Color& color, double factor) {
  const auto part = [&](double value) { return std::clamp(factor * value, 0.0, 1.0); };
  return {part(color.red), part(color.green), part(color.blue)};
}

Color tint(const Color& color, double share) {
  const auto part = [&](double value) { return value + share * (1.0 - value); };
  return {part(color.red), part(color.green), part(color.blue)};
}

std::string hex(const Color& color) {
  const auto part = [](double value) { return std::lround(255.0 * value); };
  MENISCUS_ASSERT(std::min({color.red, color.green, color.blue}) >= 0.0 &&
                      std::max({color.red, color.green, color.blue}) <= 1.0,
                  "the colour ({:g}, {:g}, {:g})", color.red, color.green, color.blue);
  return fmt::format("#{:02x}{:02x}{:02x}", part(color.red), part(color.green), part(color.blue));
}

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
