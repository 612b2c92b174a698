#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/finite_element_flow.hpp"

namespace meniscus::fem::test {

/// Finite elements with the mesh that they are lent.
class MeshedFlow {
 public:
  explicit MeshedFlow(const Options& options = {}, const MovingMeshOptions& mesh_options = {})
      : mesh(mesh_options), solver(make_finite_element_flow(options)) {}

  /// Makes the tetrahedra of a scene, of another connectivity than all before.
  void follow(const Scene& scene) {
    const MeshChange change = mesh.follow(scene);
    ASSERT_TRUE(change.ok()) << change.text();
    ++connectivity;
    solver->follow(change, domain(scene));
  }
  [[nodiscard]] FlowDomain domain(const Scene& scene) const {
    return {scene, &mesh.tetrahedra(), connectivity};
  }
  /// The flow in a scene of the connectivity followed last.
  FlowSolution solve(const Scene& scene, double t = 0.0) {
    mesh.place_interfaces(scene);
    return solver->solve(domain(scene), {.t = t});
  }
  [[nodiscard]] Archive saved(const Scene& scene) const {
    Archive archive;
    mesh.save(archive);
    solver->save(archive, domain(scene));
    return archive;
  }
  void load(const Archive& archive, const Scene& scene) {
    mesh.load(archive, scene);
    ++connectivity;
    solver->load(archive, domain(scene));
  }

  MovingMesh mesh;
  std::unique_ptr<FlowSolver> solver;
  std::int64_t connectivity = 0;
};

/// The flow in a scene; a failure of the mesh or the solver fails the test.
[[nodiscard]] inline FlowSolution flow_in(const Scene& scene, const Options& options = {},
                                          const MovingMeshOptions& mesh_options = {}) {
  MeshedFlow flow(options, mesh_options);
  flow.follow(scene);
  FlowSolution solution = flow.solve(scene);
  EXPECT_TRUE(solution.ok()) << solution.text();
  return solution;
}

}  // namespace meniscus::fem::test
