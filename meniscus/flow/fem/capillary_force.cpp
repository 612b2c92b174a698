#include "meniscus/flow/fem/capillary_force.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/edge_interpolation.hpp"
#include "meniscus/surface/edge_middles.hpp"

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

void add_weak_force(const Field<NodeId, double>& tension, const FaceNodeTable& faces,
                    const NodePositions& positions, Field<NodeId, Vec3>& force) {
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    for (const FacePoint& point : face_points(positions.x, nodes)) {
      double here = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) here += point.value[i] * tension[nodes[i]];
      for (std::size_t i = 0; i < nodes.size(); ++i)
        force[nodes[i]] -= here * point.area.norm() * point.gradient[i];
    }
  }
}

Field<NodeId, double> node_tension(const Interface& interface, const FaceNodeTable& faces,
                                   const NodePositions& positions) {
  const SurfaceMesh& mesh = interface.mesh;
  const VertexField<double> at_vertices = vertex_tension(interface);
  Field<NodeId, double> tension(positions.x.size(), 0.0);
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) tension[faces.of(f)[k]] = at_vertices[mesh.faces[f][k]];
  if (faces.nodes_per_face == 3) return tension;
  const SurfaceTopology topology(mesh);
  const FaceField<std::array<std::size_t, 3>> edges = face_edges(mesh, topology);
  std::vector<Vec3> middles(topology.edges().size());
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) middles[edges[f][k]] = positions.x[faces.of(f)[3 + k]];
  VertexField<Vec3> normals = vertex_area_vectors(mesh);
  for (Vec3& n : normals) n.normalize();
  const std::vector<double> at_middles =
      interpolated(edge_stencils(mesh, topology, normals, middles), at_vertices);
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) tension[faces.of(f)[3 + k]] = at_middles[edges[f][k]];
  return tension;
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
  MENISCUS_ASSERT(form == CapillaryForm::weak || !has_varying_tension(interface),
                  "the tension of drop {} varies with another than the weak form", interface.drop);
  if (has_varying_tension(interface))
    return add_weak_force(node_tension(interface, faces, positions), faces, positions, force);
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
