#include "meniscus/evolve/interface_motion.hpp"

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/constants.hpp"
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
  if (normal != MotionNormal::fit)
    return SmoothSurface(mesh, SurfaceTopology(mesh)).vertex_normals();
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  VertexField<Vec3> n(mesh.num_vertices());
  for (const VertexId v : n.ids()) n[v] = fit[v].n;
  return n;
}

}  // namespace

InterfaceNormals interface_normals(const Scene& scene, MotionNormal normal) {
  InterfaceNormals normals;
  for (const Interface& interface : scene.interfaces)
    normals.push_back(motion_normals(interface.mesh, normal));
  return normals;
}

NormalSpeeds normal_speeds(const InterfaceNormals& normals,
                           std::span<const VertexField<Vec3>> velocity) {
  MENISCUS_ASSERT(velocity.size() == normals.size(), "{} velocities of {} interfaces",
                  velocity.size(), normals.size());
  NormalSpeeds speeds;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    VertexField<double>& speed = speeds.emplace_back(normals[i].size());
    for (const VertexId v : speed.ids()) speed[v] = normals[i][v].dot(velocity[i][v]);
  }
  return speeds;
}

InterfaceMotion normal_motion(const InterfaceNormals& normals, const NormalSpeeds& speeds) {
  InterfaceMotion motion = normals;
  for (std::size_t i = 0; i < motion.size(); ++i)
    for (const VertexId v : motion[i].ids()) motion[i][v] *= speeds[i][v];
  return motion;
}

InterfaceMotion normal_motion(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                              MotionNormal normal) {
  const InterfaceNormals normals = interface_normals(scene, normal);
  return normal_motion(normals, normal_speeds(normals, velocity));
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

double surface_energy_rate(const Scene& scene, const InterfaceMotion& motion) {
  double rate = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    rate += interface.tension *
            ReconstructedSurface(interface.mesh, SurfaceShape::faceted).area_rate(motion[i]);
  }
  return rate;
}

InterfaceMotion mean_motion(const Scene& start, const Scene& end, double dt) {
  InterfaceMotion motion;
  for (std::size_t i = 0; i < start.interfaces.size(); ++i) {
    const VertexField<Vec3>&x0 = start.interfaces[i].mesh.x, &x1 = end.interfaces[i].mesh.x;
    MENISCUS_ASSERT(x0.size() == x1.size(), "interface {} had {} vertices, has {}", i, x0.size(),
                    x1.size());
    VertexField<Vec3>& w = motion.emplace_back(x0.size());
    for (const VertexId v : w.ids()) w[v] = (x1[v] - x0[v]) / dt;
  }
  return motion;
}

std::optional<Fault> find_wild_motion(const Scene& start, const Scene& end) {
  for (std::size_t i = 0; i < end.interfaces.size(); ++i) {
    const Interface& interface = end.interfaces[i];
    if (!is_finite(interface.mesh))
      return Fault{FaultKind::not_finite, "an interface vertex left all bounds"};
    const double ratio =
        enclosed_volume(interface.mesh) / enclosed_volume(start.interfaces[i].mesh);
    if (!(ratio > kLeastVolumeKept && ratio < kMostVolumeKept))
      return Fault{
          FaultKind::wrong_volume,
          fmt::format("the step takes drop {} to {:.3g} times its volume", interface.drop, ratio)};
  }
  return {};
}

}  // namespace meniscus
