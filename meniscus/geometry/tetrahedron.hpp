#pragma once

#include <array>

#include <Eigen/Geometry>

#include "meniscus/core/vec.hpp"

namespace meniscus {

[[nodiscard]] inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
[[nodiscard]] inline double dot(const Vec3& a, const Vec3& b) { return a.dot(b); }

/// The straight tetrahedron in barycentric coordinates. `Vector` has dot and cross: Vec3, or plain
/// numbers where compilers are to make vectors across cells.
template <class Vector>
struct BarycentricTetrahedron {
  double volume = 0.0;               ///< signed [R0³]
  std::array<Vector, 4> gradient{};  ///< of the barycentric coordinates, sum zero [1/R0]
};
using LinearTetrahedron = BarycentricTetrahedron<Vec3>;

/// Not finite where the corners lie in a plane.
template <class Vector>
[[nodiscard]] inline BarycentricTetrahedron<Vector> linear_tetrahedron(
    const std::array<Vector, 4>& corners) {
  const Vector& o = corners[0];
  const Vector e1 = corners[1] - o, e2 = corners[2] - o, e3 = corners[3] - o;
  const Vector n1 = cross(e2, e3), n2 = cross(e3, e1), n3 = cross(e1, e2);
  const double determinant = dot(e1, n1), scale = 1.0 / determinant;
  return {determinant / 6.0, {-scale * (n1 + n2 + n3), scale * n1, scale * n2, scale * n3}};
}
[[nodiscard]] inline LinearTetrahedron linear_tetrahedron(const std::array<Vec3, 4>& corners) {
  return linear_tetrahedron<Vec3>(corners);
}

/// The barycentric coordinates of p in a straight tetrahedron that is not flat.
[[nodiscard]] inline std::array<double, 4> barycentric_coordinates(
    const std::array<Vec3, 4>& corners, const Vec3& p) {
  const Vec3& o = corners[0];
  const Vec3 e1 = corners[1] - o, e2 = corners[2] - o, e3 = corners[3] - o, d = p - o;
  const Vec3 n1 = e2.cross(e3);
  const double scale = 1.0 / e1.dot(n1);
  const double b1 = scale * d.dot(n1), b2 = scale * d.dot(e3.cross(e1)),
               b3 = scale * d.dot(e1.cross(e2));
  return {1.0 - b1 - b2 - b3, b1, b2, b3};
}

}  // namespace meniscus
