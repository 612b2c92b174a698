#include "meniscus/evolve/interface_motion.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus {
namespace {

VertexField<Vec3> motion_normals(const SurfaceMesh& mesh, MotionNormal normal) {
  if (normal == MotionNormal::area_vector) {
    VertexField<Vec3> n = vertex_area_vectors(mesh);
    for (Vec3& each : n) each.normalize();
    return n;
  }
  if (normal == MotionNormal::smooth)
    return SmoothSurface(mesh, SurfaceTopology(mesh)).vertex_normals();
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  VertexField<Vec3> n(mesh.num_vertices());
  for (const VertexId v : n.ids()) n[v] = fit[v].n;
  return n;
}

}  // namespace

InterfaceMotion normal_motion(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                              MotionNormal normal) {
  MENISCUS_ASSERT(velocity.size() == scene.interfaces.size(), "{} velocities of {} interfaces",
                  velocity.size(), scene.interfaces.size());
  InterfaceMotion motion;
  motion.reserve(scene.interfaces.size());
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    VertexField<Vec3> n = motion_normals(scene.interfaces[i].mesh, normal);
    for (const VertexId v : n.ids()) n[v] *= n[v].dot(velocity[i][v]);
    motion.push_back(std::move(n));
  }
  return motion;
}

void move_interfaces(Scene& scene, const InterfaceMotion& motion, double dt) {
  MENISCUS_ASSERT(motion.size() == scene.interfaces.size(), "{} motions of {} interfaces",
                  motion.size(), scene.interfaces.size());
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    VertexField<Vec3>& x = scene.interfaces[i].mesh.x;
    for (const VertexId v : x.ids()) x[v] += dt * motion[i][v];
  }
}

Vec3 centroid_of_drops(const Scene& scene) {
  Vec3 moment = Vec3::Zero();
  double volume = 0.0;
  for (const Interface& interface : scene.interfaces) {
    if (interface.outside != RegionId{0}) continue;
    const double enclosed = enclosed_volume(interface.mesh);
    moment += enclosed * enclosed_centroid(interface.mesh);
    volume += enclosed;
  }
  return moment / volume;
}

void translate_interfaces(Scene& scene, const Vec3& shift) {
  for (Interface& interface : scene.interfaces)
    for (Vec3& x : interface.mesh.x) x += shift;
}

double surface_energy_rate(const Scene& scene, const InterfaceMotion& motion,
                           SurfaceShape surface) {
  double rate = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    rate += interface.tension * ReconstructedSurface(interface.mesh, surface).area_rate(motion[i]);
  }
  return rate;
}

}  // namespace meniscus
