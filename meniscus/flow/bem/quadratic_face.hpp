#pragma once

#include <array>

#include "meniscus/core/vec.hpp"

namespace meniscus::bem {

/// The six nodes of a curved triangle: corners 0, 1, 2, then the middle of the edge opposite each.
inline constexpr int kFaceNodes = 6;
using FaceNodes = std::array<Vec3, kFaceNodes>;
using NodeValues = std::array<double, kFaceNodes>;

/// The quadratic functions that are 1 at one node and 0 at the others.
[[nodiscard]] inline NodeValues quadratic_shape(const Vec3& b) {
  return {b[0] * (2.0 * b[0] - 1.0), b[1] * (2.0 * b[1] - 1.0), b[2] * (2.0 * b[2] - 1.0),
          4.0 * b[1] * b[2],         4.0 * b[2] * b[0],         4.0 * b[0] * b[1]};
}

struct FacePoint {
  Vec3 x;
  Vec3 area;  ///< n dS per share of a rule: ½ ∂x/∂b1 × ∂x/∂b2
};
/// Position and area vector at barycentric b, on the parabolic triangle through the nodes.
[[nodiscard]] FacePoint face_point(const FaceNodes& nodes, const Vec3& b);

}  // namespace meniscus::bem
