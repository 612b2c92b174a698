#include "tests/flow/fem/analytic_middles.hpp"

#include <stdexcept>

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/flow/fem/vertex_velocity.hpp"

namespace meniscus::fem {

VertexField<Vec3> velocity_with_middles(const Scene& scene, const Method& method,
                                        const std::function<Vec3(VertexId, VertexId)>& middle) {
  TetMesh mesh;
  if (const VolumeMeshReport made = tetrahedralize(scene, method.volume_mesh, mesh); !made.ok())
    throw std::runtime_error(made.text());
  const FlowSpace space = flow_space(mesh, method.elements);
  const Interface& drop = scene.interfaces[0];
  const FaceNodeTable faces = face_nodes(space, mesh, drop.mesh, mesh.interfaces[0]);
  NodePositions positions = node_positions(scene, mesh, space);
  const SurfaceTopology topology(drop.mesh);
  std::vector<Vec3> middles;
  for (const SurfaceEdge& edge : topology.edges()) middles.push_back(middle(edge.a, edge.b));
  curve_edges(drop.mesh, topology, faces, middles, positions);
  const FaceNodeTable wall = face_nodes(space, mesh, scene.boundary.mesh, mesh.boundary);
  settle_curved_cells(mesh, space, std::vector{faces, wall}, positions);
  StokesProblem problem(mesh, space, positions);
  for (const CellId c : mesh.cells.ids()) {
    problem.viscosity[c] = scene.liquids[mesh.region[c]].viscosity;
    problem.body_force[c] = scene.liquids[mesh.region[c]].body_force;
  }
  problem.constraints = boundary_conditions(scene.boundary, wall, positions, 0.0).constraints;
  if (drop.tension != 0.0) add_capillary_force(drop, method.form, faces, positions, problem.force);
  Options options;
  options.elements = method.elements;
  options.rtol = method.rtol;
  StokesSolver solver(space, options);
  StokesState state = state_at_rest(space);
  PhaseTimes times;
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
  if (!report.ok()) throw std::runtime_error(report.text());
  if (!method.shows_corners) return vertex_velocity(drop.mesh, faces, positions, state.v);
  VertexField<Vec3> velocity(drop.mesh.num_vertices());
  for (const VertexId v : velocity.ids())
    velocity[v] = state.v[node_at(mesh.interfaces[0].vertex(v))];
  return velocity;
}

}  // namespace meniscus::fem
