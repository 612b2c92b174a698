#include "meniscus/evolve/interface_motion.hpp"

#include <algorithm>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/curved_measures.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

VertexField<Vec3> motion_normals(const SurfaceMesh& mesh, MotionNormal normal) {
  if (normal == MotionNormal::area_vector) {
    VertexField<Vec3> n = vertex_area_vectors(mesh);
    for (Vec3& each : n) each.normalize();
    return n;
  }
  if (normal == MotionNormal::smooth) return smooth_normals(mesh);
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  VertexField<Vec3> n(mesh.num_vertices());
  for (const VertexId v : n.ids()) n[v] = fit[v].n;
  return n;
}

/// dS/dt of the parabolic faces by a central difference over displacements of a ten-thousandth of
/// an edge: its error, some 1e-8 of the rate, is that of the square and of round-off alike.
double curved_area_rate(const SurfaceMesh& mesh, const VertexField<Vec3>& motion,
                        SurfaceShape surface) {
  double fastest = 0.0;
  for (const Vec3& w : motion) fastest = std::max(fastest, w.norm());
  if (fastest == 0.0) return 0.0;
  const double dt = 1e-4 * shortest_edge(mesh) / fastest;
  const auto area_after = [&](double time) {
    SurfaceMesh moved = mesh;
    for (const VertexId v : motion.ids()) moved.x[v] += time * motion[v];
    return curved_measures(moved, surface).area;
  };
  return (area_after(dt) - area_after(-dt)) / (2.0 * dt);
}

}  // namespace

InterfaceMotion normal_motion(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                              MotionNormal normal) {
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

double restore_volume(SurfaceMesh& mesh, double volume, SurfaceShape surface) {
  return surface == SurfaceShape::faceted ? restore_volume(mesh, volume)
                                          : restore_curved_volume(mesh, volume, surface);
}

double volume_of(const SurfaceMesh& mesh, SurfaceShape surface) {
  return surface == SurfaceShape::faceted ? enclosed_volume(mesh)
                                          : curved_measures(mesh, surface).volume;
}

double surface_energy_rate(const Scene& scene, const InterfaceMotion& motion,
                           SurfaceShape surface) {
  double rate = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    if (surface != SurfaceShape::faceted) {
      rate += interface.tension * curved_area_rate(interface.mesh, motion[i], surface);
      continue;
    }
    const VertexField<Vec3> gradient = area_gradient(interface.mesh);
    for (const VertexId v : gradient.ids())
      rate += interface.tension * gradient[v].dot(motion[i][v]);
  }
  return rate;
}

}  // namespace meniscus
