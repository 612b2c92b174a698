#pragma once

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "tests/flow/fem/box_mesh.hpp"

namespace meniscus::fem {

/// A space on a mesh at rest, and what it makes of the outer boundary. The mesh must outlive it.
struct TestSpace {
  explicit TestSpace(const TetMesh& on, Elements elements = Elements::p1_p1)
      : mesh(on), space(flow_space(on, elements)), positions(straight_positions(on, space)) {}
  /// With the curved surfaces of a scene.
  TestSpace(const Scene& scene, const TetMesh& on, Elements elements)
      : mesh(on), space(flow_space(on, elements)), positions(node_positions(scene, on, space)) {}

  [[nodiscard]] StokesProblem problem() const { return {mesh, space, positions}; }
  [[nodiscard]] BoundaryConditions conditions(const OuterBoundary& boundary) const {
    return boundary_conditions(boundary, face_nodes(space, mesh, boundary.mesh, mesh.boundary),
                               positions, 0.0);
  }

  const TetMesh& mesh;
  FlowSpace space;
  NodePositions positions;
};

inline Options with(Elements elements, Options options = {}) {
  options.elements = elements;
  return options;
}

}  // namespace meniscus::fem
