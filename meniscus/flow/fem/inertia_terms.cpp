#include "meniscus/flow/fem/inertia_terms.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus::fem {

FaceStiffness face_stiffness(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes,
                             double factor) {
  MENISCUS_ASSERT(nodes.size() == 6, "{} nodes", nodes.size());
  FaceStiffness face;
  std::ranges::copy(nodes, face.nodes.begin());
  for (const FacePoint& point : face_points(x, nodes)) {
    Eigen::Matrix<double, 3, 6> gradients;
    for (std::size_t i = 0; i < 6; ++i)
      gradients.col(static_cast<Eigen::Index>(i)) = point.gradient[i];
    face.values += factor * point.area.norm() * gradients.transpose() * gradients;
  }
  return face;
}

Eigen::Matrix<double, 6, 6> FaceElasticity::mean_of_components() const {
  Eigen::Matrix<double, 6, 6> mean = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      mean(i, j) = values.block<3, 3>(3 * i, 3 * j).trace() / 3.0;
  return mean;
}

FaceElasticity face_elasticity(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes,
                               const Vec3& E) {
  MENISCUS_ASSERT(nodes.size() == 6, "{} nodes", nodes.size());
  FaceElasticity face;
  std::ranges::copy(nodes, face.nodes.begin());
  const FacePoints points = face_points(x, nodes);
  for (std::size_t q = 0; q < points.size(); ++q) {
    Eigen::Vector<double, 18> divergence;
    for (std::size_t i = 0; i < 6; ++i)
      divergence.segment<3>(3 * static_cast<Eigen::Index>(i)) = points[q].gradient[i];
    const Eigen::Map<const Vec3> corners(kTriangleRule6[q].barycentric.data());
    face.values += E.dot(corners) * points[q].area.norm() * divergence * divergence.transpose();
  }
  return face;
}

}  // namespace meniscus::fem
