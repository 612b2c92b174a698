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
/// Stands between the points of a line where it is broken.
inline constexpr PicturePoint gap = {std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::quiet_NaN()};

/// A line of a picture: the `d` of its path, and the points that stand alone between gaps.
struct CurvePath {
  std::string line;
  std::vector<PicturePoint> dots;
};

/// More points than a picture can show are thinned: of each run of neighbours the lowest and the
/// highest stay, so that no spike is lost.
[[nodiscard]] CurvePath curve_path(std::span<const PicturePoint> points);

}  // namespace meniscus::report
