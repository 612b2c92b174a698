#include "meniscus/evolve/drop_stress.hpp"

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curved_measures.hpp"

namespace meniscus {
namespace {

/// ∫ nn dS.
Mat3 normal_moment(const SurfaceMesh& mesh) {
  Mat3 sum = Mat3::Zero();
  for (const FaceId f : mesh.faces.ids()) {
    const Vec3 area = face_area_vector(mesh, f);
    const double size = area.norm();
    if (size > 0.0) sum += area * area.transpose() / size;
  }
  return sum;
}

/// ∫ un dS: for linear u on flat faces Σ_i u_i A_i exactly.
Mat3 velocity_moment(const SurfaceMesh& mesh, const VertexField<Vec3>& u) {
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  Mat3 sum = Mat3::Zero();
  for (const VertexId v : u.ids()) sum += u[v] * area[v].transpose();
  return sum;
}

SurfaceMoments moments_of(const SurfaceMesh& mesh, const VertexField<Vec3>& u,
                          SurfaceShape surface) {
  if (surface != SurfaceShape::faceted) return curved_moments(mesh, u, surface);
  return {enclosed_volume(mesh), normal_moment(mesh), velocity_moment(mesh, u)};
}

}  // namespace

Mat3 drop_stress(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                 SurfaceShape surface, std::span<const Mat3> excess) {
  Mat3 total = Mat3::Zero();
  double volume = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    const double contrast =
        scene.liquids[interface.inside].viscosity - scene.liquids[interface.outside].viscosity;
    const SurfaceMoments moments = moments_of(interface.mesh, velocity[i], surface);
    // I − nn − 2/3 I with ∫ dS = tr ∫ nn dS.
    const Mat3 capillary = moments.normals.trace() / 3.0 * Mat3::Identity() - moments.normals;
    total += interface.tension * capillary +
             contrast * (moments.velocity + moments.velocity.transpose());
    if (interface.outside == RegionId{0}) volume += moments.volume;
  }
  for (std::size_t region = 1; region < excess.size(); ++region) total += excess[region];
  return volume > 0.0 ? Mat3(total / volume) : total;
}

}  // namespace meniscus
