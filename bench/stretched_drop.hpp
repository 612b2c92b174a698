#pragma once

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::fem {

/// A spherical drop in uniaxial extension at Ca = 0.17, on a mesh graded toward it.
inline Scene stretched_drop(int num_vertices, double lambda) {
  const Mat3 gradient = ImposedFlow::uniaxial_extension();
  return sphere_in_sphere(
      {.num_vertices = num_vertices,
       .viscosity_ratio = lambda,
       .Ca = 0.17,
       .outer_per_inner = 1.25,
       .outer_velocity = [gradient](const Vec3& x, double) { return Vec3(gradient * x); },
       .is_linear_flow = true});
}

/// The flow problem of that instant, with the weak capillary force.
inline StokesProblem instant(const Scene& scene, const TetMesh& mesh, const FlowSpace& space) {
  StokesProblem problem(mesh, space, node_positions(scene, mesh, space));
  for (const CellId c : mesh.cells.ids())
    problem.viscosity[c] = scene.liquids[mesh.region[c]].viscosity;
  problem.constraints =
      boundary_conditions(scene.boundary,
                          face_nodes(space, mesh, scene.boundary.mesh, mesh.boundary),
                          problem.positions, 0.0)
          .constraints;
  add_capillary_force(scene.interfaces[0], CapillaryForm::weak,
                      face_nodes(space, mesh, scene.interfaces[0].mesh, mesh.interfaces[0]),
                      problem.positions, problem.load);
  return problem;
}

}  // namespace meniscus::fem
