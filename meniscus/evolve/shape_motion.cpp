#include "meniscus/evolve/shape_motion.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/constants.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// Where a point at x of the start is after `duration` of the rigid part of a motion, about the
/// first center of the shape.
Vec3 carried(const Vec3& x, const RigidMotion& first, RigidMotion motion, double duration) {
  motion.center = first.center;
  return motion.moved(x, duration);
}

}  // namespace

Vec3 centroid_velocity(const SurfaceMesh& mesh, const VertexField<double>& swept) {
  const Vec3 centroid = enclosed_centroid(mesh);
  Vec3 moment = Vec3::Zero();
  for (const VertexId v : swept.ids()) moment += swept[v] * (mesh.x[v] - centroid);
  return moment / enclosed_volume(mesh);
}

RigidMotion rigid_motion_of_shape(const SurfaceMesh& mesh, const VertexField<Vec3>& velocity) {
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  RigidMotion shape{.center = enclosed_centroid(mesh)};
  VertexField<double> swept;
  for (const VertexId v : area.ids()) swept.add(area[v].dot(velocity[v]));
  shape.velocity = centroid_velocity(mesh, swept);
  const Vec3 spin =
      RigidProjection(mesh)([&](VertexId v) -> const Vec3& { return velocity[v]; }).spin;
  double agreement = 0.0, scale = 0.0;
  for (const VertexId v : area.ids()) {
    const Vec3 turning = spin.cross(mesh.x[v] - shape.center);
    const double size = area[v].norm(), normal_part = area[v].dot(turning) / size;
    agreement += normal_part * area[v].dot(velocity[v] - shape.velocity);
    scale += size * (normal_part * normal_part + kRoundness * turning.squaredNorm());
  }
  if (scale > 0.0) shape.spin = std::clamp(agreement / scale, 0.0, 1.0) * spin;
  return shape;
}

ShapeMotion shape_motion(const Scene& scene, const InterfaceNormals& normals,
                         std::span<const VertexField<Vec3>> velocity) {
  MENISCUS_ASSERT(velocity.size() == scene.interfaces.size(), "{} velocities of {} interfaces",
                  velocity.size(), scene.interfaces.size());
  ShapeMotion motion{{}, normals};
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const SurfaceMesh& mesh = scene.interfaces[i].mesh;
    const RigidMotion& rigid = motion.rigid.emplace_back(rigid_motion_of_shape(mesh, velocity[i]));
    for (const VertexId v : velocity[i].ids())
      motion.rest[i][v] *= normals[i][v].dot(velocity[i][v] - rigid.at(mesh.x[v]));
  }
  return motion;
}

InterfaceMotion velocity_of(const ShapeMotion& motion, const Scene& scene) {
  InterfaceMotion velocity = motion.rest;
  for (std::size_t i = 0; i < velocity.size(); ++i)
    for (const VertexId v : velocity[i].ids())
      velocity[i][v] += motion.rigid[i].at(scene.interfaces[i].mesh.x[v]);
  return velocity;
}

InterfaceMotion mean_motion(const Scene& start, const ShapeMotion& first, const ShapeMotion& motion,
                            double duration) {
  MENISCUS_ASSERT(duration > 0.0, "a motion within {:g}", duration);
  InterfaceMotion velocity = motion.rest;
  for (std::size_t i = 0; i < velocity.size(); ++i)
    for (const VertexId v : velocity[i].ids()) {
      const Vec3& x = start.interfaces[i].mesh.x[v];
      velocity[i][v] += (carried(x, first.rigid[i], motion.rigid[i], duration) - x) / duration;
    }
  return velocity;
}

}  // namespace meniscus
