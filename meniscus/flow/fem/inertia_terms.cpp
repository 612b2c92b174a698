#include "meniscus/flow/fem/inertia_terms.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"

namespace meniscus::fem {

FaceNodes::FaceNodes(std::span<const NodeId> nodes) : size_(nodes.size()) {
  MENISCUS_ASSERT(size_ == 3 || size_ == 6, "{} nodes", size_);
  std::ranges::copy(nodes, nodes_.begin());
}

FaceStiffness face_stiffness(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes,
                             double factor) {
  FaceStiffness face{FaceNodes(nodes)};
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
  FaceElasticity face{FaceNodes(nodes)};
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

namespace {

/// Adds what the faces' stiffness makes of a velocity.
void add_stiffness(std::span<const FaceStiffness> faces, std::span<const double> v,
                   std::span<double> momentum) {
  for (const FaceStiffness& face : faces) {
    Eigen::Matrix<double, 6, 3> at_nodes = Eigen::Matrix<double, 6, 3>::Zero();
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        at_nodes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            v[3 * static_cast<std::size_t>(face.nodes[i].value) + k];
    const Eigen::Matrix<double, 6, 3> force = face.values * at_nodes;
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        momentum[3 * static_cast<std::size_t>(face.nodes[i].value) + k] +=
            force(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  }
}

/// The same of what their elasticity makes.
void add_stiffness(std::span<const FaceElasticity> faces, std::span<const double> v,
                   std::span<double> momentum) {
  for (const FaceElasticity& face : faces) {
    Eigen::Vector<double, 18> at_nodes = Eigen::Vector<double, 18>::Zero();
    const auto first = [&](std::size_t i) {
      return 3 * static_cast<std::size_t>(face.nodes[i].value);
    };
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      at_nodes.segment<3>(3 * static_cast<Eigen::Index>(i)) =
          Eigen::Map<const Vec3>(v.data() + first(i));
    const Eigen::Vector<double, 18> force = face.values * at_nodes;
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      Eigen::Map<Vec3>(momentum.data() + first(i)) +=
          force.segment<3>(3 * static_cast<Eigen::Index>(i));
  }
}

}  // namespace

void InertiaTerms::add_tension(std::span<const double> v, std::span<double> momentum) const {
  add_stiffness(tension, v, momentum);
  add_stiffness(elasticity, v, momentum);
}

}  // namespace meniscus::fem
