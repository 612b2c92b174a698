#pragma once

#include <array>
#include <limits>

#include "meniscus/core/vec.hpp"

namespace meniscus::fem {

/// P_l and its derivative at c, l ≥ 0.
struct Legendre {
  double value, derivative;
};
[[nodiscard]] Legendre legendre(int l, double c);

/// Stokes flow inside and outside the unit sphere, driven by a radial traction jump P_l(cos θ) on
/// it (outer minus inner), at rest on a concentric sphere of radius `b` or at infinity. θ is the
/// angle to the x-axis. By Lamb's general solution.
class LambMode {
 public:
  LambMode(int l, double lambda, double b = std::numeric_limits<double>::infinity());
  [[nodiscard]] Vec3 velocity(const Vec3& x) const;
  /// Radial velocity on the unit sphere over P_l.
  [[nodiscard]] double radial_amplitude() const;

 private:
  int l_;
  /// Amplitudes of p and Φ: growing inside; decaying, growing outside.
  std::array<double, 6> amplitude_{};
};

/// Rate of decay of r = 1 + ε P_l for Ca = 1: the traction jump is κ = 2 + (l − 1)(l + 2) ε P_l.
[[nodiscard]] double relaxation_rate(int l, double lambda,
                                     double b = std::numeric_limits<double>::infinity());

}  // namespace meniscus::fem
