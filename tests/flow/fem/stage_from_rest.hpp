#pragma once

#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {

/// What the liquids of a stage are; the matrix has the viscosity 1.
struct StageLiquids {
  double viscosity_ratio = 1.0, density = 1.0, density_ratio = 1.0;
};

/// Drops in a sphere of radius 10 that something drives so little that nothing convects: a force
/// across their axis, or walls in uniaxial extension at Ca = 0.17.
[[nodiscard]] SphereScene pushed_drop(int num_vertices);
[[nodiscard]] SphereScene extended_drop(int num_vertices);

/// Implicit stages of a drop in a sphere that begin at rest, by linear systems with fresh
/// preconditioners. The mesh is made once.
class StageFromRest {
 public:
  /// The shape replaces the sphere of the scene; its drop has the volume of the unit sphere.
  StageFromRest(const SphereScene& options, DropShape shape, Elements elements);

  /// The stage of so long a duration; without inertia where it is infinite.
  [[nodiscard]] StokesReport solve(const StageLiquids& liquids, double duration);
  /// τ = s ρh²/μ of the matrix, h the mean edge of the interface. Infinite where s is.
  [[nodiscard]] double duration_of(double s, double density) const;
  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] const FlowSpace& space() const { return space_; }
  [[nodiscard]] StokesProblem problem(const StageLiquids& liquids, double duration);

 private:
  Scene scene_;
  TetMesh mesh_;
  FlowSpace space_;
};

}  // namespace meniscus::fem
