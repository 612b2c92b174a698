#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Dense>

#include "meniscus/core/cube_root.hpp"
#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/geometry/tetrahedron.hpp"

namespace meniscus::fem {

/// A quadrature point of a cell, with all that the forms integrate there.
template <std::size_t Nodes>
struct ElementPoint {
  double weight = 0.0;                ///< [R0³]
  std::array<double, 4> pressure{};   ///< ψ_k of the four corners
  std::array<double, Nodes> value{};  ///< φ_i
  /// ∇φ_i by columns [1/R0].
  Eigen::Matrix<double, 3, Nodes> gradient = Eigen::Matrix<double, 3, Nodes>::Zero();
};

/// φ_i of the quadratic tetrahedron at barycentric b: the four corners, then the middles of the
/// edges in the order of `kCellEdges`.
[[nodiscard]] std::array<double, 10> quadratic_tetrahedron_values(const std::array<double, 4>& b);

/// Stabilisation parameter τ = 0.25 h²/μ, h half the edge of the regular tetrahedron of equal
/// volume, V = (2h)³/(6√2). It is eq. 11 of hooper2001; the division by μ is not printed there.
[[nodiscard]] inline double pspg_parameter(double volume, double viscosity) {
  return cube_root(72.0 * volume * volume) / (16.0 * viscosity);
}
/// With inertia, in a stage of length T: 1/(1/τ + ρ/T) (badia2009), ρ/T being given. It weighs the
/// residual of the whole momentum.
[[nodiscard]] inline double pspg_parameter(double volume, double viscosity, double mass_rate) {
  return 1.0 / (1.0 / pspg_parameter(volume, viscosity) + mass_rate);
}

/// P1 velocity on straight tetrahedra: gradients are constant, and one point makes every form
/// exact.
class LinearElement {
 public:
  static constexpr std::size_t num_nodes = 4;
  static constexpr bool is_stabilized = true;
  using Point = ElementPoint<num_nodes>;

  LinearElement(const FlowSpace& space, const NodePositions& positions)
      : space_(space), positions_(positions) {}
  /// Valid until the next call.
  [[nodiscard]] std::span<const Point> points(CellId c);

 private:
  const FlowSpace& space_;
  const NodePositions& positions_;
  std::array<Point, 1> points_;
};

/// Isoparametric P2 velocity: x(ξ) = Σ x_i φ_i(ξ). 4 points where the cell is straight, 14 where it
/// is curved.
class QuadraticElement {
 public:
  static constexpr std::size_t num_nodes = 10;
  static constexpr bool is_stabilized = false;
  using Point = ElementPoint<num_nodes>;

  QuadraticElement(const FlowSpace& space, const NodePositions& positions)
      : space_(space), positions_(positions) {}
  [[nodiscard]] std::span<const Point> points(CellId c);

 private:
  [[nodiscard]] std::span<const Point> straight_points(CellId c);
  [[nodiscard]] std::span<const Point> curved_points(CellId c);
  const FlowSpace& space_;
  const NodePositions& positions_;
  std::array<Point, kTetrahedronRule5.size()> points_;
};

/// Calls `action` with the element that a space is made of.
template <class Action>
void with_element(const FlowSpace& space, const NodePositions& positions, Action action) {
  if (space.elements == Elements::p2_p1) {
    QuadraticElement element(space, positions);
    return action(element);
  }
  LinearElement element(space, positions);
  return action(element);
}

/// ∫φ_iφ_j/V of a straight quadratic tetrahedron.
inline constexpr std::array<std::array<double, 10>, 10> kQuadraticMass = [] {
  std::array<std::array<double, 10>, 10> mass{};
  const auto touches = [](std::size_t e, std::size_t k) {
    return kCellEdges[e][0] == k || kCellEdges[e][1] == k;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) mass[i][j] = i == j ? 6.0 : 1.0;
    for (std::size_t e = 0; e < 6; ++e) mass[i][4 + e] = mass[4 + e][i] = touches(e, i) ? -4 : -6;
  }
  for (std::size_t e = 0; e < 6; ++e)
    for (std::size_t f = 0; f < 6; ++f)
      mass[4 + e][4 + f] =
          e == f ? 32.0
                 : (touches(e, kCellEdges[f][0]) || touches(e, kCellEdges[f][1]) ? 16.0 : 8.0);
  for (auto& row : mass)
    for (double& each : row) each /= 420.0;
  return mass;
}();

}  // namespace meniscus::fem
