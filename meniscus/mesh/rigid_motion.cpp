#include "meniscus/mesh/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {

Vec3 RigidMotion::at(const Vec3& x) const { return velocity + spin.cross(x - center); }

Vec3 RigidMotion::moved(const Vec3& x, double duration) const {
  const double rate = spin.norm();
  const Vec3 axis = rate > 0.0 ? Vec3(spin / rate) : Vec3(Vec3::UnitX());
  const Eigen::AngleAxisd turn(rate * duration, axis);
  return center + duration * velocity + turn * (x - center);
}

RigidProjection::RigidProjection(const SurfaceMesh& mesh)
    : weight_(vertex_areas(mesh)), arm_(mesh.x), center_(Vec3::Zero()) {
  for (const VertexId v : mesh.x.ids()) {
    total_ += weight_[v];
    center_ += weight_[v] * mesh.x[v];
  }
  center_ /= total_;
  Mat3 inertia = Mat3::Zero();
  for (const VertexId v : arm_.ids()) {
    Vec3& r = arm_[v];
    r -= center_;
    inertia += weight_[v] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  inverse_inertia_ = inertia.inverse();
}

Vec3 RigidProjection::cross(const Vec3& a, const Vec3& b) { return a.cross(b); }

}  // namespace meniscus
