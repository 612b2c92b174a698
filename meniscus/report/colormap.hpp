#pragma once

#include <span>
#include <string>

namespace meniscus::report {

/// A colour of screen, each part in [0, 1].
struct Color {
  double red = 0.0, green = 0.0, blue = 0.0;
};

/// Viridis at s in [0, 1] (values beyond are clamped): lightness rises evenly with s, readable
/// without colour vision.
[[nodiscard]] Color viridis(double s);
/// `shade` multiplies brightness by a factor; `tint` mixes in a share of white in [0, 1].
[[nodiscard]] Color shade(const Color& color, double factor);
[[nodiscard]] Color tint(const Color& color, double share);
[[nodiscard]] std::string hex(const Color& color);  ///< "#rrggbb"

/// A range of values and the part of viridis that shows it.
struct ValueRange {
  double low = 0.0, high = 1.0;
  double first = 0.0, last = 1.0;  ///< the part of viridis in [0, 1]
  [[nodiscard]] double fraction(double value) const { return (value - low) / (high - low); }
  [[nodiscard]] Color color(double value) const {
    return viridis(first + (last - first) * fraction(value));
  }
};

/// The range from the 1st to the 99th percentile of the finite values, so that a few outliers do
/// not take the colours. Its width is at least a fiftieth of the values.
[[nodiscard]] ValueRange color_range(std::span<const double> values);

}  // namespace meniscus::report
