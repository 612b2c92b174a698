#include "meniscus/flow/fem/instant_problem.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/flow/fem/linear_inertia.hpp"
#include "meniscus/flow/fem/scalar_coupling.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus::fem {
namespace {

/// The nodes of the faces of every embedded surface.
struct SurfaceNodes {
  std::vector<FaceNodeTable> interfaces;
  FaceNodeTable boundary;
};

SurfaceNodes surface_nodes(const Scene& scene, const TetMesh& mesh, const FlowSpace& space) {
  SurfaceNodes nodes;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    nodes.interfaces.push_back(
        face_nodes(space, mesh, scene.interfaces[i].mesh, mesh.interfaces[i]));
  nodes.boundary = face_nodes(space, mesh, scene.boundary.mesh, mesh.boundary);
  return nodes;
}

/// Velocities at the nodes of an interface's faces of what is given at its vertices. At the middles
/// of edges, where they are nodes, they are half way between.
void add_at_faces(const SurfaceMesh& surface, const FaceNodeTable& faces,
                  const VertexField<Vec3>& at_vertices, Field<NodeId, Vec3>& to) {
  for (const FaceId f : surface.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &here = at_vertices[surface.faces[f][k]],
                 &next = at_vertices[surface.faces[f][(k + 1) % 3]];
      to[faces.of(f)[k]] = here;
      if (faces.nodes_per_face == 6) to[faces.of(f)[3 + k]] = 0.5 * (here + next);
    }
}

/// What the stage of a domain adds by inertia, the nodes being at x.
InertiaTerms inertia_terms(const FlowDomain& domain, const Field<NodeId, Vec3>& x,
                           std::span<const FaceNodeTable> interfaces) {
  const ImplicitStage& stage = *domain.stage;
  const Scene& scene = domain.scene;
  MENISCUS_ASSERT(stage.x.size() == x.span().size() && stage.v.size() == stage.x.size(),
                  "{} nodes, {} before", x.size(), stage.x.size());
  InertiaTerms terms{.duration = stage.duration};
  for (const CellId c : domain.mesh->cells.ids())
    terms.density.add(scene.liquids[domain.mesh->region[c]].density);
  terms.before = Field<NodeId, Vec3>(stage.v);
  for (const NodeId i : x.ids())
    terms.mesh_velocity.add((x[i] - stage.x[static_cast<std::size_t>(i.value)]) / stage.duration);
  terms.interface_went = Field<NodeId, Vec3>(x.size(), Vec3::Zero());
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0 || stage.slowing.empty()) continue;
    add_at_faces(interface.mesh, interfaces[i], stage.slowing[i], terms.interface_went);
    const double factor = stage.duration * largest_tension(interface);
    const VertexField<double> elasticity = vertex_elasticity(interface);
    for (const FaceId f : interfaces[i].faces()) {
      const std::span<const NodeId> nodes = interfaces[i].of(f);
      terms.tension.push_back(face_stiffness(x, nodes, factor));
      if (elasticity.size() == 0) continue;
      const FaceVertices& v = interface.mesh.faces[f];
      terms.elasticity.push_back(face_elasticity(
          x, nodes, stage.duration * Vec3(elasticity[v[0]], elasticity[v[1]], elasticity[v[2]])));
    }
  }
  std::vector<char> is_done(stage.x.size(), 0);
  for (const FaceStiffness& face : terms.tension)
    for (const NodeId i : face.nodes)
      if (std::exchange(is_done[static_cast<std::size_t>(i.value)], 1) == 0)
        terms.interface_went[i] += stage.expected_v[static_cast<std::size_t>(i.value)];
  return terms;
}

}  // namespace

ImplicitStage stage_at_rest(const Scene& scene, double duration, const Field<NodeId, Vec3>& x) {
  const std::vector<Vec3> zeros(x.span().size(), Vec3::Zero());
  ImplicitStage stage{duration, {x.begin(), x.end()}, zeros, zeros, {}};
  for (const Interface& interface : scene.interfaces)
    stage.slowing.emplace_back(interface.mesh.num_vertices(), Vec3::Zero());
  return stage;
}

FlowDomain with_stage(const FlowDomain& domain, const ImplicitStage& stage) {
  FlowDomain result = domain;
  result.known = nullptr;
  result.stage = &stage;
  return result;
}

InstantProblem instant_problem(const FlowDomain& domain, const FlowSpace& space,
                               NodePositions positions, CapillaryForm form, double t) {
  const Scene& scene = domain.scene;
  const TetMesh& mesh = *domain.mesh;
  InstantProblem problem{StokesProblem(mesh, space, std::move(positions)), {}, {}};
  const NodePositions& at = problem.stokes.positions;
  const SurfaceNodes nodes = surface_nodes(scene, mesh, space);
  for (const CellId c : mesh.cells.ids()) {
    const Liquid& liquid = scene.liquids[mesh.region[c]];
    problem.stokes.viscosity[c] = liquid.viscosity;
    problem.stokes.body_force[c] = liquid.body_force;
  }
  if (!std::ranges::all_of(scene.liquids, is_newtonian, &Liquid::law))
    for (const Liquid& liquid : scene.liquids) problem.stokes.laws.add(liquid.law);
  if (domain.stage != nullptr) {
    problem.stokes.inertia = inertia_terms(domain, at.x, nodes.interfaces);
    problem.stokes.undisturbed = problem.stokes.inertia->before;
  } else {
    problem.stokes.undisturbed.reserve(at.x.size());
    for (const Vec3& x : at.x) problem.stokes.undisturbed.add(scene.flow.velocity(x, t));
  }
  BoundaryConditions conditions = boundary_conditions(scene.boundary, nodes.boundary, at, t);
  problem.fault = std::move(conditions.fault);
  problem.stokes.constraints = std::move(conditions.constraints);
  problem.stokes.has_open_boundary = conditions.has_open_patch;
  problem.traction = std::move(conditions.traction);
  if (domain.scalars != nullptr) {
    const CellField<double> factors = viscosity_factors(scene, mesh, space, *domain.scalars);
    for (const CellId c : mesh.cells.ids()) problem.stokes.viscosity[c] *= factors[c];
    add_buoyancy(scene, *domain.scalars, problem.stokes, problem.traction);
  }
  if (problem.stokes.inertia && space.elements == Elements::p1_p1)
    remember_divergence(problem.stokes);
  problem.stokes.force = problem.traction;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    if (scene.interfaces[i].tension != 0.0)
      add_capillary_force(scene.interfaces[i], form, nodes.interfaces[i], at, problem.stokes.force);
  return problem;
}

}  // namespace meniscus::fem
