#include "meniscus/flow/bem/quadratic_face.hpp"

#include <Eigen/Geometry>

namespace meniscus::bem {

FacePoint face_point(const FaceNodes& nodes, const Vec3& b) {
  const NodeValues shape = quadratic_shape(b);
  Vec3 x = Vec3::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a) x += shape[a] * nodes[a];
  // ∂/∂b_k with the b independent; along the face b0 = 1 − b1 − b2.
  const Vec3 d0 = (4.0 * b[0] - 1.0) * nodes[0] + 4.0 * (b[2] * nodes[4] + b[1] * nodes[5]);
  const Vec3 d1 = (4.0 * b[1] - 1.0) * nodes[1] + 4.0 * (b[2] * nodes[3] + b[0] * nodes[5]);
  const Vec3 d2 = (4.0 * b[2] - 1.0) * nodes[2] + 4.0 * (b[1] * nodes[3] + b[0] * nodes[4]);
  return {x, 0.5 * (d1 - d0).cross(d2 - d0)};
}

}  // namespace meniscus::bem
