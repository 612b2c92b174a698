#include "meniscus/evolve/drop_stress.hpp"

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

Mat3 capillary_part(const SurfaceMesh& mesh) {
  Mat3 sum = Mat3::Zero();
  for (const FaceId f : mesh.faces.ids()) {
    const Vec3 area = face_area_vector(mesh, f);
    const double size = area.norm();
    if (size > 0.0) sum += size / 3.0 * Mat3::Identity() - area * area.transpose() / size;
  }
  return sum;
}

Mat3 viscous_part(const SurfaceMesh& mesh, const VertexField<Vec3>& u) {
  // Linear u on flat faces: ∫_S u n dS = Σ_i u_i A_i exactly.
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  Mat3 sum = Mat3::Zero();
  for (const VertexId v : u.ids()) sum += u[v] * area[v].transpose();
  return sum + sum.transpose();
}

}  // namespace

Mat3 drop_stress(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                 std::span<const Mat3> excess) {
  Mat3 total = Mat3::Zero();
  double volume = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    const double contrast =
        scene.liquids[interface.inside].viscosity - scene.liquids[interface.outside].viscosity;
    total += interface.tension * capillary_part(interface.mesh) +
             contrast * viscous_part(interface.mesh, velocity[i]);
    if (interface.outside == RegionId{0}) volume += enclosed_volume(interface.mesh);
  }
  for (std::size_t region = 1; region < excess.size(); ++region) total += excess[region];
  return volume > 0.0 ? Mat3(total / volume) : total;
}

}  // namespace meniscus
