#include "meniscus/flow/fem/elements.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "meniscus/flow/fem/curved_maps.hpp"

namespace meniscus::fem {
namespace {

using Barycentric = std::array<double, 4>;
using Gradients = Eigen::Matrix<double, 3, 10>;

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

template <std::size_t Count>
std::array<std::array<double, 10>, Count> values_at(
    const std::array<QuadraturePoint<4>, Count>& rule) {
  std::array<std::array<double, 10>, Count> values;
  for (std::size_t q = 0; q < Count; ++q)
    values[q] = quadratic_tetrahedron_values(rule[q].barycentric);
  return values;
}
const auto kStraightValues = values_at(kTetrahedronRule2);
const auto kCurvedValues = values_at(kTetrahedronRule5);

std::array<Vec3, 4> corners(const Field<NodeId, Vec3>& x, std::span<const std::int32_t> nodes) {
  return {x[NodeId{nodes[0]}], x[NodeId{nodes[1]}], x[NodeId{nodes[2]}], x[NodeId{nodes[3]}]};
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
  return positions_.is_curved[c] ? curved_points(c) : straight_points(c);
}

std::span<const QuadraticElement::Point> QuadraticElement::straight_points(CellId c) {
  const LinearTetrahedron tet = linear_tetrahedron(corners(positions_.x, space_.velocity.of(c)));
  for (std::size_t q = 0; q < kTetrahedronRule2.size(); ++q) {
    const auto& [barycentric, share] = kTetrahedronRule2[q];
    points_[q].weight = share * tet.volume;
    points_[q].pressure = barycentric;
    points_[q].value = kStraightValues[q];
    points_[q].gradient = quadratic_gradients(barycentric, tet.gradient);
  }
  return std::span(points_).first(kTetrahedronRule2.size());
}

std::span<const QuadraticElement::Point> QuadraticElement::curved_points(CellId c) {
  const CurvedMaps maps = curved_maps(positions_.x, space_.velocity, std::span(&c, 1)).front();
  for (std::size_t q = 0; q < maps.size(); ++q) {
    const std::array<Vec3, 3>& g = maps[q].gradient;
    points_[q].weight = maps[q].weight;
    points_[q].pressure = kTetrahedronRule5[q].barycentric;
    points_[q].value = kCurvedValues[q];
    points_[q].gradient = quadratic_gradients(kTetrahedronRule5[q].barycentric,
                                              {-(g[0] + g[1] + g[2]), g[0], g[1], g[2]});
  }
  return points_;
}

}  // namespace meniscus::fem
