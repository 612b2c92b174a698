#pragma once

#include <span>

#include "meniscus/core/vec.hpp"

namespace meniscus::bem {

/// A point of a triangle and its share of the integral; the shares of a rule sum to 1.
struct RulePoint {
  Vec3 weights = Vec3::Zero();  ///< barycentric
  double share = 0.0;
};

/// Seven points, exact for polynomials of degree 5 [radon1948].
[[nodiscard]] std::span<const RulePoint> smooth_rule();
/// For integrands like 1/r about a corner: Gauss points in (s, t) of b = 1 − s at the corner,
/// s(1 − t) and st at the others, whose Jacobian s makes them smooth [duffy1982].
[[nodiscard]] std::span<const RulePoint> corner_rule(int corner);

}  // namespace meniscus::bem
