#include "meniscus/flow/fem/face_elements.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/quadratic_triangle.hpp"

namespace meniscus::fem {
namespace {

template <std::size_t Nodes>
using RuleShapes = std::array<TriangleShape<Nodes>, kTriangleRule6.size()>;

template <std::size_t Nodes>
constexpr RuleShapes<Nodes> rule_shapes(
    TriangleShape<Nodes> (*shape)(const std::array<double, 3>&)) {
  RuleShapes<Nodes> shapes;
  for (std::size_t q = 0; q < shapes.size(); ++q) shapes[q] = shape(kTriangleRule6[q].barycentric);
  return shapes;
}
constexpr RuleShapes<3> kLinear = rule_shapes(linear_shape);
constexpr RuleShapes<6> kQuadratic = rule_shapes(quadratic_shape);

template <std::size_t Nodes>
FacePoint face_point(const TriangleNodes<Nodes>& x, const TriangleShape<Nodes>& shape,
                     double share) {
  const TriangleTangents at = tangents(shape, x);
  const TriangleGradients gradients = surface_gradients(at);
  FacePoint point;
  point.x = weighted_sum(shape.value, x);
  point.area = share * at.area();
  for (std::size_t i = 0; i < Nodes; ++i) {
    point.value[i] = shape.value[i];
    point.gradient[i] = shape.by_1[i] * gradients.g1 + shape.by_2[i] * gradients.g2;
  }
  for (std::size_t i = Nodes; i < point.gradient.size(); ++i) point.gradient[i].setZero();
  return point;
}

template <std::size_t Nodes>
FacePoints points_of(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes,
                     const RuleShapes<Nodes>& shapes) {
  TriangleNodes<Nodes> at;
  for (std::size_t i = 0; i < Nodes; ++i) at[i] = x[nodes[i]];
  FacePoints points;
  for (std::size_t q = 0; q < points.size(); ++q)
    points[q] = face_point(at, shapes[q], kTriangleRule6[q].share);
  return points;
}

}  // namespace

FacePoints face_points(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes) {
  MENISCUS_ASSERT(nodes.size() == 3 || nodes.size() == 6, "{} nodes", nodes.size());
  return nodes.size() == 3 ? points_of(x, nodes, kLinear) : points_of(x, nodes, kQuadratic);
}

Field<NodeId, Vec3> node_area_vectors(const FaceNodeTable& faces, const Field<NodeId, Vec3>& x) {
  Field<NodeId, Vec3> area(x.size(), Vec3::Zero());
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    for (const FacePoint& point : face_points(x, nodes))
      for (std::size_t i = 0; i < nodes.size(); ++i) area[nodes[i]] += point.value[i] * point.area;
  }
  return area;
}

}  // namespace meniscus::fem
