#include "meniscus/flow/fem/face_elements.hpp"

#include <Eigen/Dense>

namespace meniscus::fem {
namespace {

/// Values of the shape functions and their derivatives by the barycentric coordinates of corners 1
/// and 2.
struct Shape {
  std::array<double, 6> value{};
  std::array<std::array<double, 2>, 6> derivative{};
};

constexpr std::array<std::array<double, 2>, 3> kCornerDerivatives = {{{-1, -1}, {1, 0}, {0, 1}}};

Shape linear_shape(const std::array<double, 3>& b) {
  Shape shape;
  for (std::size_t i = 0; i < 3; ++i) {
    shape.value[i] = b[i];
    shape.derivative[i] = kCornerDerivatives[i];
  }
  return shape;
}

Shape quadratic_shape(const std::array<double, 3>& b) {
  Shape shape;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    shape.value[i] = b[i] * (2.0 * b[i] - 1.0);
    shape.value[3 + i] = 4.0 * b[i] * b[j];
    for (std::size_t d = 0; d < 2; ++d) {
      shape.derivative[i][d] = (4.0 * b[i] - 1.0) * kCornerDerivatives[i][d];
      shape.derivative[3 + i][d] =
          4.0 * (b[i] * kCornerDerivatives[j][d] + b[j] * kCornerDerivatives[i][d]);
    }
  }
  return shape;
}

FacePoint face_point(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes,
                     const RulePoint<3>& at) {
  const Shape shape =
      nodes.size() == 3 ? linear_shape(at.barycentric) : quadratic_shape(at.barycentric);
  FacePoint point;
  point.value = shape.value;
  Vec3 t1 = Vec3::Zero(), t2 = Vec3::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    point.x += shape.value[i] * x[nodes[i]];
    t1 += shape.derivative[i][0] * x[nodes[i]];
    t2 += shape.derivative[i][1] * x[nodes[i]];
  }
  point.area = 0.5 * at.share * t1.cross(t2);
  Eigen::Matrix2d metric;
  metric << t1.dot(t1), t1.dot(t2), t1.dot(t2), t2.dot(t2);
  const Eigen::Matrix2d inverse = metric.inverse();
  const Vec3 dual1 = inverse(0, 0) * t1 + inverse(0, 1) * t2;
  const Vec3 dual2 = inverse(1, 0) * t1 + inverse(1, 1) * t2;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    point.gradient[i] = shape.derivative[i][0] * dual1 + shape.derivative[i][1] * dual2;
  return point;
}

}  // namespace

FacePoints face_points(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes) {
  FacePoints points;
  for (std::size_t q = 0; q < points.size(); ++q) points[q] = face_point(x, nodes, kFaceRule[q]);
  return points;
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
