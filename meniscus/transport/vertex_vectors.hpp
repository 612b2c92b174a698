#pragma once

#include <vector>

#include <Eigen/Core>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Values of vertices as Eigen has them, and back.
[[nodiscard]] inline Eigen::VectorXd vector_of(const VertexField<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.span().data(), values.size());
}
[[nodiscard]] inline VertexField<double> field_of(const Eigen::VectorXd& values) {
  return VertexField<double>(std::vector<double>(values.begin(), values.end()));
}

}  // namespace meniscus
