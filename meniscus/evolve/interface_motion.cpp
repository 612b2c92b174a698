#include "meniscus/evolve/interface_motion.hpp"

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curvature.hpp"

namespace meniscus {
namespace {

VertexField<Vec3> motion_normals(const SurfaceMesh& mesh, MotionNormal normal) {
  if (normal == MotionNormal::area_vector) {
    VertexField<Vec3> n = vertex_area_vectors(mesh);
    for (Vec3& each : n) each.normalize();
    return n;
  }
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  VertexField<Vec3> n(mesh.num_vertices());
  for (const VertexId v : n.ids()) n[v] = fit[v].n;
  return n;
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

double surface_energy_rate(const Scene& scene, const InterfaceMotion& motion) {
  double rate = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    const VertexField<Vec3> gradient = area_gradient(interface.mesh);
    for (const VertexId v : gradient.ids())
      rate += interface.tension * gradient[v].dot(motion[i][v]);
  }
  return rate;
}

}  // namespace meniscus
