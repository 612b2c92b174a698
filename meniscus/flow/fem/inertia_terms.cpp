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

}  // namespace meniscus::fem
