#pragma once

#include <algorithm>

namespace meniscus {

/// Over the middle of an edge a fitted surface is trusted to this many of the edge's lengths, a
/// little more than the height of a circle over the sides of its regular triangle. Where vertices
/// lie as on a crease, fits swing out by a hundred.
constexpr double kHighestMiddle = 0.3;

/// How far a fit is to be trusted: 1 up to a limit of what it is judged by, fading out until twice
/// that, so that what is fitted follows the vertices without jumps.
[[nodiscard]] inline double trust(double size, double limit) {
  return std::clamp(2.0 - size / limit, 0.0, 1.0);
}

}  // namespace meniscus
