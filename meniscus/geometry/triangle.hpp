#pragma once

#include <array>
#include <optional>

#include "meniscus/core/vec.hpp"

namespace meniscus {

using Triangle = std::array<Vec3, 3>;

/// A point of a triangle: its position and its weights Σ w_k x_k, Σ w_k = 1.
struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  Vec3 weights = Vec3::Zero();
};

/// The point of a triangle nearest to p. Weights of the corners and edges that it does not touch
/// are exactly zero. Defined for triangles without area too.
[[nodiscard]] TrianglePoint closest_point(const Triangle& triangle, const Vec3& p);

/// The distance t ≥ 0 along a ray from `origin` in the unit direction `direction` to the triangle.
/// Tolerant: a ray through an edge, to 1e-9 of its length, counts as a hit of both faces, so that
/// no ray slips between them.
struct RayHit {
  double t = 0.0;
  Vec3 weights = Vec3::Zero();
};
[[nodiscard]] std::optional<RayHit> intersect_ray(const Triangle& triangle, const Vec3& origin,
                                                  const Vec3& direction);

}  // namespace meniscus
