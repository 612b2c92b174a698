#include "meniscus/flow/fem/capillary_force.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curvature.hpp"

namespace meniscus::fem {
namespace {

void add_nodal_force(const Interface& interface, const FaceNodeTable& faces,
                     Field<NodeId, Vec3>& force) {
  MENISCUS_ASSERT(faces.nodes_per_face == 3, "{}", faces.nodes_per_face);
  const SurfaceMesh& mesh = interface.mesh;
  const VertexField<VertexCurvature> fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  for (const FaceId f : mesh.faces.ids()) {
    const double third = face_area_vector(mesh, f).norm() / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexCurvature& at = fit[mesh.faces[f][k]];
      force[faces.of(f)[k]] -= interface.tension * third * at.sum() * at.n;
    }
  }
}

/// κ at the vertices, and half way between them at the middles of edges.
Field<NodeId, double> fitted_kappa(const SurfaceMesh& mesh, const FaceNodeTable& faces,
                                   std::int32_t num_nodes) {
  const SurfaceTopology topology(mesh);
  // The paraboloid is too curved by O(h²), which quadratic elements would notice.
  const VertexField<VertexCurvature> fit = faces.nodes_per_face == 3
                                               ? fitted_curvature(mesh, topology)
                                               : osculating_curvature(mesh, topology);
  Field<NodeId, double> kappa(num_nodes, 0.0);
  for (const FaceId f : mesh.faces.ids()) {
    const auto nodes = faces.of(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const double here = fit[mesh.faces[f][k]].sum();
      kappa[nodes[k]] = here;
      if (nodes.size() == 6)
        kappa[nodes[3 + k]] = 0.5 * (here + fit[mesh.faces[f][(k + 1) % 3]].sum());
    }
  }
  return kappa;
}

}  // namespace

void add_weak_force(double tension, const FaceNodeTable& faces, const NodePositions& positions,
                    Field<NodeId, Vec3>& force) {
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    for (const FacePoint& point : face_points(positions.x, nodes))
      for (std::size_t i = 0; i < nodes.size(); ++i)
        force[nodes[i]] -= tension * point.area.norm() * point.gradient[i];
  }
}

void add_balanced_force(double tension, const Field<NodeId, double>& kappa,
                        const FaceNodeTable& faces, const NodePositions& positions,
                        Field<NodeId, Vec3>& force) {
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    for (const FacePoint& point : face_points(positions.x, nodes)) {
      double here = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) here += point.value[i] * kappa[nodes[i]];
      for (std::size_t i = 0; i < nodes.size(); ++i)
        force[nodes[i]] -= tension * here * point.value[i] * point.area;
    }
  }
}

void add_capillary_force(const Interface& interface, CapillaryForm form, const FaceNodeTable& faces,
                         const NodePositions& positions, Field<NodeId, Vec3>& force) {
  switch (form) {
    case CapillaryForm::weak:
      return add_weak_force(interface.tension, faces, positions, force);
    case CapillaryForm::nodal:
      return add_nodal_force(interface, faces, force);
    case CapillaryForm::balanced:
      break;
  }
  add_balanced_force(interface.tension, fitted_kappa(interface.mesh, faces, force.size()), faces,
                     positions, force);
}

}  // namespace meniscus::fem
