#pragma once

#include <algorithm>

#include "meniscus/surface/constants.hpp"

namespace meniscus {

/// How far a fit is to be trusted. It is 1 up to a limit of what the fit is judged by, fading to 0
/// at twice the limit. So what is fitted follows the vertices without jumps.
[[nodiscard]] inline double trust(double size, double limit) {
  return std::clamp(2.0 - size / limit, 0.0, 1.0);
}

}  // namespace meniscus
