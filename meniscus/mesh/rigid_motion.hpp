#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The velocity of a rigid body, v(x) = velocity + spin × (x − center).
struct RigidMotion {
  Vec3 center = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();
  [[nodiscard]] Vec3 at(const Vec3& x) const;
  /// Where a point of the body is after `duration`, if the center is the body's own.
  [[nodiscard]] Vec3 moved(const Vec3& x, double duration) const;
};

/// Least-squares fits of rigid motions to velocities at the vertices of one surface, weighted by
/// the vertices' areas. They are the projection P with P φ = φ for rigid φ.
class RigidProjection {
 public:
  explicit RigidProjection(const SurfaceMesh& mesh);
  template <class VelocityAt>
  [[nodiscard]] RigidMotion operator()(VelocityAt&& velocity) const {
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    for (const VertexId v : weight_.ids()) {
      const Vec3 u = weight_[v] * velocity(v);
      momentum += u;
      angular += cross(arm_[v], u);
    }
    return {center_, momentum / total_, inverse_inertia_ * angular};
  }

 private:
  static Vec3 cross(const Vec3& a, const Vec3& b);
  VertexField<double> weight_;
  VertexField<Vec3> arm_;
  Vec3 center_;
  double total_ = 0.0;
  Mat3 inverse_inertia_;
};

}  // namespace meniscus
