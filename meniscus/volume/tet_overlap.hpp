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

/// A tetrahedron of positive volume as the intersection of four half spaces.
class HalfSpaceTet {
 public:
  HalfSpaceTet() = default;
  explicit HalfSpaceTet(const TetCorners& tet);

  [[nodiscard]] const TetCorners& corners() const { return corners_; }
  /// Positive where p lies on the inner side of the facet opposite corner k.
  [[nodiscard]] double depth(std::size_t k, const Vec3& p) const {
    return inward_[k].dot(p) - offset_[k];
  }

 private:
  TetCorners corners_;
  std::array<Vec3, 4> inward_;
  std::array<double, 4> offset_{};
};

/// The moments of what two tetrahedra have in common, exact but for round-off. The first is clipped
/// by those half spaces of the second that cut it, and stays a union of tetrahedra.
[[nodiscard]] VolumeMoments tet_overlap(const HalfSpaceTet& a, const HalfSpaceTet& b);

/// The point of a tetrahedron nearest to p, with its weights Σ w_k x_k, w_k ≥ 0, Σ w_k = 1.
struct TetPoint {
  Vec3 point = Vec3::Zero();
  std::array<double, 4> weights{};
};
[[nodiscard]] TetPoint closest_point(const TetCorners& tet, const Vec3& p);

}  // namespace meniscus
