#include "meniscus/flow/fem/elements.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace meniscus::fem {
namespace {

using Barycentric = std::array<double, 4>;
using Gradients = Eigen::Matrix<double, 3, 10>;

/// Gradients of ξ, η, ζ and 1 − ξ − η − ζ in the reference tetrahedron, corner 0 at its origin.
const std::array<Vec3, 4> kReferenceGradients = {Vec3(-1, -1, -1), Vec3::UnitX(), Vec3::UnitY(),
                                                 Vec3::UnitZ()};

/// By columns, from the gradients of the barycentric coordinates.
Gradients quadratic_gradients(const Barycentric& b, const std::array<Vec3, 4>& g) {
  Gradients gradient;
  for (std::size_t i = 0; i < 4; ++i)
    gradient.col(static_cast<Eigen::Index>(i)) = (4.0 * b[i] - 1.0) * g[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kCellEdges[e];
    gradient.col(static_cast<Eigen::Index>(4 + e)) = 4.0 * (b[i] * g[j] + b[j] * g[i]);
  }
  return gradient;
}

/// What the points of a rule have in common for every cell.
template <std::size_t Count>
struct ReferencePoints {
  std::array<std::array<double, 10>, Count> value;
  std::array<Gradients, Count> gradient;

  explicit ReferencePoints(const std::array<QuadraturePoint<4>, Count>& rule) {
    for (std::size_t q = 0; q < Count; ++q) {
      value[q] = quadratic_tetrahedron_values(rule[q].barycentric);
      gradient[q] = quadratic_gradients(rule[q].barycentric, kReferenceGradients);
    }
  }
};
const ReferencePoints<kTetrahedronRule2.size()> kStraight(kTetrahedronRule2);
const ReferencePoints<kTetrahedronRule5.size()> kCurved(kTetrahedronRule5);

Eigen::Matrix<double, 10, 3> node_positions(const Field<NodeId, Vec3>& x,
                                            std::span<const std::int32_t> nodes) {
  Eigen::Matrix<double, 10, 3> rows;
  for (std::size_t i = 0; i < 10; ++i)
    rows.row(static_cast<Eigen::Index>(i)) = x[NodeId{nodes[i]}].transpose();
  return rows;
}

std::array<Vec3, 4> corners(const Field<NodeId, Vec3>& x, std::span<const std::int32_t> nodes) {
  return {x[NodeId{nodes[0]}], x[NodeId{nodes[1]}], x[NodeId{nodes[2]}], x[NodeId{nodes[3]}]};
}

Barycentric node_barycentric(std::size_t node) {
  Barycentric b{};
  if (node < 4) {
    b[node] = 1.0;
  } else {
    b[kCellEdges[node - 4][0]] = b[kCellEdges[node - 4][1]] = 0.5;
  }
  return b;
}

}  // namespace

std::array<double, 10> quadratic_tetrahedron_values(const std::array<double, 4>& b) {
  std::array<double, 10> value{};
  for (std::size_t i = 0; i < 4; ++i) value[i] = b[i] * (2.0 * b[i] - 1.0);
  for (std::size_t e = 0; e < 6; ++e)
    value[4 + e] = 4.0 * b[kCellEdges[e][0]] * b[kCellEdges[e][1]];
  return value;
}

std::span<const LinearElement::Point> LinearElement::points(CellId c) {
  const LinearTetrahedron tet = linear_tetrahedron(corners(positions_.x, space_.velocity.of(c)));
  Point& point = points_[0];
  point.weight = tet.volume;
  point.pressure.fill(0.25);
  point.value.fill(0.25);
  for (std::size_t i = 0; i < 4; ++i)
    point.gradient.col(static_cast<Eigen::Index>(i)) = tet.gradient[i];
  return points_;
}

std::span<const QuadraticElement::Point> QuadraticElement::points(CellId c) {
  const auto nodes = space_.velocity.of(c);
  return positions_.is_curved[c] ? curved_points(nodes) : straight_points(nodes);
}

std::span<const QuadraticElement::Point> QuadraticElement::straight_points(
    std::span<const std::int32_t> nodes) {
  const LinearTetrahedron tet = linear_tetrahedron(corners(positions_.x, nodes));
  for (std::size_t q = 0; q < kTetrahedronRule2.size(); ++q) {
    const auto& [barycentric, share] = kTetrahedronRule2[q];
    points_[q].weight = share * tet.volume;
    points_[q].pressure = barycentric;
    points_[q].value = kStraight.value[q];
    points_[q].gradient = quadratic_gradients(barycentric, tet.gradient);
  }
  return std::span(points_).first(kTetrahedronRule2.size());
}

std::span<const QuadraticElement::Point> QuadraticElement::curved_points(
    std::span<const std::int32_t> nodes) {
  const std::array<CurvedMap, kTetrahedronRule5.size()> maps = curved_maps(positions_.x, nodes);
  for (std::size_t q = 0; q < maps.size(); ++q) {
    const std::array<Vec3, 3>& g = maps[q].gradient;
    points_[q].weight = maps[q].weight;
    points_[q].pressure = kTetrahedronRule5[q].barycentric;
    points_[q].value = kCurved.value[q];
    points_[q].gradient = quadratic_gradients(kTetrahedronRule5[q].barycentric,
                                              {-(g[0] + g[1] + g[2]), g[0], g[1], g[2]});
  }
  return points_;
}

std::array<CurvedMap, kTetrahedronRule5.size()> curved_maps(const Field<NodeId, Vec3>& x,
                                                            std::span<const std::int32_t> nodes) {
  const Eigen::Matrix<double, 10, 3> positions = node_positions(x, nodes);
  std::array<CurvedMap, kTetrahedronRule5.size()> maps;
  for (std::size_t q = 0; q < maps.size(); ++q) {
    const Mat3 jacobian = kCurved.gradient[q] * positions;  // ∂x_b/∂ξ_a at (a, b)
    const Mat3 inverse = jacobian.inverse();
    maps[q] = {kTetrahedronRule5[q].share * jacobian.determinant() / 6.0,
               {inverse.col(0), inverse.col(1), inverse.col(2)}};
  }
  return maps;
}

double least_jacobian(const Field<NodeId, Vec3>& x, std::span<const std::int32_t> nodes) {
  const Eigen::Matrix<double, 10, 3> positions = node_positions(x, nodes);
  double least = std::numeric_limits<double>::infinity();
  for (const Gradients& gradient : kCurved.gradient)
    least = std::min(least, Mat3(gradient * positions).determinant());
  for (std::size_t i = 0; i < 10; ++i) {
    const Gradients gradient = quadratic_gradients(node_barycentric(i), kReferenceGradients);
    least = std::min(least, Mat3(gradient * positions).determinant());
  }
  return least;
}

}  // namespace meniscus::fem
