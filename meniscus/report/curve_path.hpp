#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace meniscus::report {

/// A point of a picture [px], y downwards.
struct PicturePoint {
  double x = 0.0, y = 0.0;
};
/// A point that separates two pieces of a line.
inline constexpr PicturePoint gap = {std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::quiet_NaN()};

/// A line of a picture: the `d` of its SVG path, and the isolated points between gaps.
struct CurvePath {
  std::string line;
  std::vector<PicturePoint> dots;
};

/// The path through points. Where there are more points than a picture can show, each bucket of
/// neighbours keeps its lowest and highest, so that no spike is lost.
[[nodiscard]] CurvePath curve_path(std::span<const PicturePoint> points);

}  // namespace meniscus::report
