#pragma once

#include <gtest/gtest.h>

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::fem {

/// A flattened drop of high tension and a body force, in a shear flow inside a sphere.
struct ShearedDrop {
  Scene scene;
  TetMesh mesh;
  FlowSpace space;

  explicit ShearedDrop(Elements elements = Elements::p1_p1) {
    Mat3 gradient = Mat3::Zero();
    gradient(0, 1) = 1.0;
    scene = sphere_in_sphere(
        {.num_vertices = 110,
         .outer_radius = 4.0,
         .viscosity_ratio = 3.0,
         .Ca = 0.3,
         .outer_velocity = [gradient](const Vec3& x, double) { return Vec3(gradient * x); },
         .is_linear_flow = true,
         .drop_force = Vec3(0.0, 0.4, -0.7)});
    for (Vec3& x : scene.interfaces[0].mesh.x) x = x.cwiseProduct(Vec3(1.2, 1.0, 0.8));
    EXPECT_TRUE(tetrahedralize(scene, {}, mesh).ok());
    space = flow_space(mesh, elements);
  }
  StokesProblem problem() const {
    StokesProblem problem(mesh, space, node_positions(scene, mesh, space));
    for (const CellId c : mesh.cells.ids()) {
      problem.viscosity[c] = scene.liquids[mesh.region[c]].viscosity;
      problem.body_force[c] = scene.liquids[mesh.region[c]].body_force;
    }
    problem.constraints =
        boundary_conditions(scene.boundary,
                            face_nodes(space, mesh, scene.boundary.mesh, mesh.boundary),
                            problem.positions, 0.0)
            .constraints;
    add_capillary_force(scene.interfaces[0], CapillaryForm::weak, drop_faces(), problem.positions,
                        problem.force);
    return problem;
  }
  FaceNodeTable drop_faces() const {
    return face_nodes(space, mesh, scene.interfaces[0].mesh, mesh.interfaces[0]);
  }
};

}  // namespace meniscus::fem
