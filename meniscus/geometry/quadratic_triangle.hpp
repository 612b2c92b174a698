#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Geometry>

#include "meniscus/core/vec.hpp"

namespace meniscus {

/// The one order of nodes of every quadratic triangle: the corners 0, 1, 2, then the middles of the
/// edges 01, 12, 20. A triangle of three nodes is straight.
inline constexpr int kQuadraticNodes = 6;
template <std::size_t Nodes>
using TriangleNodes = std::array<Vec3, Nodes>;

/// The linear or quadratic functions that are 1 at one node and 0 at the others. Their derivatives
/// are by b1 and b2, b0 = 1 − b1 − b2.
template <std::size_t Nodes>
struct TriangleShape {
  std::array<double, Nodes> value{}, by_1{}, by_2{};
};

[[nodiscard]] constexpr TriangleShape<3> linear_shape(const std::array<double, 3>& b) {
  return {.value = b, .by_1 = {-1.0, 1.0, 0.0}, .by_2 = {-1.0, 0.0, 1.0}};
}

/// The values of these functions, without derivatives.
[[nodiscard]] constexpr std::array<double, 6> quadratic_values(const std::array<double, 3>& b) {
  return {b[0] * (2.0 * b[0] - 1.0), b[1] * (2.0 * b[1] - 1.0), b[2] * (2.0 * b[2] - 1.0),
          4.0 * b[0] * b[1],         4.0 * b[1] * b[2],         4.0 * b[2] * b[0]};
}

[[nodiscard]] constexpr TriangleShape<6> quadratic_shape(const std::array<double, 3>& b) {
  const double c0 = 4.0 * b[0], c1 = 4.0 * b[1], c2 = 4.0 * b[2];
  return {.value = quadratic_values(b),
          .by_1 = {1.0 - c0, c1 - 1.0, 0.0, c0 - c1, c2, -c2},
          .by_2 = {1.0 - c0, 0.0, c2 - 1.0, -c1, c1, c0 - c2}};
}

/// Σ value_i x_i.
template <std::size_t Nodes>
[[nodiscard]] inline Vec3 weighted_sum(const std::array<double, Nodes>& value,
                                       const TriangleNodes<Nodes>& x) {
  Vec3 sum = value[0] * x[0];
  for (std::size_t i = 1; i < Nodes; ++i) sum += value[i] * x[i];
  return sum;
}

/// ∂x/∂b1 and ∂x/∂b2 at a point of a triangle.
struct TriangleTangents {
  Vec3 t1, t2;
  /// n dS per share of the area, on the side from which corners run counterclockwise [R0²].
  [[nodiscard]] Vec3 area() const { return 0.5 * t1.cross(t2); }
};

template <std::size_t Nodes>
[[nodiscard]] inline TriangleTangents tangents(const TriangleShape<Nodes>& shape,
                                               const TriangleNodes<Nodes>& x) {
  return {weighted_sum(shape.by_1, x), weighted_sum(shape.by_2, x)};
}

/// The gradients along the surface of b1 and b2: in the tangent plane, g_i·t_j = δ_ij. The gradient
/// of a function f is f_1 g1 + f_2 g2. Not finite where the tangents are parallel.
struct TriangleGradients {
  Vec3 g1, g2;
};
[[nodiscard]] inline TriangleGradients surface_gradients(const TriangleTangents& at) {
  const double m11 = at.t1.squaredNorm(), m12 = at.t1.dot(at.t2), m22 = at.t2.squaredNorm();
  const double scale = 1.0 / (m11 * m22 - m12 * m12);
  const double i11 = m22 * scale, i12 = -m12 * scale, i22 = m11 * scale;
  return {i11 * at.t1 + i12 * at.t2, i12 * at.t1 + i22 * at.t2};
}

}  // namespace meniscus
