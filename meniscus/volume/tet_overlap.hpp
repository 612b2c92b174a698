#pragma once

#include <array>

#include "meniscus/core/vec.hpp"

namespace meniscus {

using TetCorners = std::array<Vec3, 4>;

/// The measure and first moment of a part of space: ∫ dV and ∫ x dV.
struct VolumeMoments {
  double volume = 0.0;         ///< [R0³]
  Vec3 moment = Vec3::Zero();  ///< [R0⁴]
};

[[nodiscard]] VolumeMoments tet_moments(const TetCorners& tet);

/// The moments of what two tetrahedra of positive volume have in common, exact but for round-off:
/// the first is clipped by the four half spaces of the second and stays a union of tetrahedra.
[[nodiscard]] VolumeMoments tet_overlap(const TetCorners& a, const TetCorners& b);

/// The point of a tetrahedron nearest to p, with its weights Σ w_k x_k, w_k ≥ 0, Σ w_k = 1.
struct TetPoint {
  Vec3 point = Vec3::Zero();
  std::array<double, 4> weights{};
};
[[nodiscard]] TetPoint closest_point(const TetCorners& tet, const Vec3& p);

}  // namespace meniscus
