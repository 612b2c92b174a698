#pragma once

#include <cmath>
#include <numbers>

namespace meniscus {

/// Radius of the sphere of a volume ≥ 0: (3V/(4π))^(1/3).
[[nodiscard]] inline double sphere_radius(double volume) {
  return std::cbrt(0.75 * volume / std::numbers::pi);
}

}  // namespace meniscus
