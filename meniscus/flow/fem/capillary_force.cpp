#include "meniscus/flow/fem/capillary_force.hpp"

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curvature.hpp"

namespace meniscus::fem {
namespace {

VertexField<Vec3> weak_force(const SurfaceMesh& mesh, double tension) {
  VertexField<Vec3> force = area_gradient(mesh);
  for (Vec3& f : force) f *= -tension;
  return force;
}

VertexField<Vec3> nodal_force(const SurfaceMesh& mesh, double tension) {
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  const VertexField<double> area = vertex_areas(mesh);
  VertexField<Vec3> force(mesh.num_vertices(), Vec3::Zero());
  for (const VertexId v : mesh.x.ids()) force[v] = -tension * area[v] * fit[v].sum() * fit[v].n;
  return force;
}

VertexField<double> fitted_kappa(const SurfaceMesh& mesh) {
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  VertexField<double> kappa(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) kappa[v] = fit[v].sum();
  return kappa;
}

}  // namespace

VertexField<Vec3> balanced_force(const SurfaceMesh& mesh, double tension,
                                 const VertexField<double>& kappa) {
  VertexField<Vec3> force(mesh.num_vertices(), Vec3::Zero());
  for (const FaceId f : mesh.faces.ids()) {
    const Vec3 area = face_area_vector(mesh, f);
    const auto& [a, b, c] = mesh.faces[f];
    const double sum = kappa[a] + kappa[b] + kappa[c];
    // ∫φ_i φ_j over a triangle is its area over 12, twice that for i = j.
    for (const VertexId v : mesh.faces[f]) force[v] -= tension / 12.0 * (sum + kappa[v]) * area;
  }
  return force;
}

VertexField<Vec3> capillary_force(const SurfaceMesh& mesh, double tension, CapillaryForm form) {
  switch (form) {
    case CapillaryForm::weak:
      return weak_force(mesh, tension);
    case CapillaryForm::nodal:
      return nodal_force(mesh, tension);
    case CapillaryForm::balanced:
      break;
  }
  return balanced_force(mesh, tension, fitted_kappa(mesh));
}

}  // namespace meniscus::fem
