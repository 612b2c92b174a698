#pragma once

#include "meniscus/flow/fem/kept_preconditioner.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/scene/scene.hpp"

// What keeps a velocity without divergence, and its momentum, where it goes to a new mesh.

namespace meniscus::fem {

/// Takes divergence out of velocities by the matrix of a stage, whose preconditioner the next stage
/// may keep.
class StageProjection {
 public:
  /// What is given must outlive this.
  StageProjection(StokesSolver& solver, StokesProblem problem, KeptPreconditioner& preconditioner,
                  PhaseTimes& times);

  StokesReport apply(Field<NodeId, Vec3>& v);
  [[nodiscard]] const NodePositions& positions() const { return problem_.positions; }
  /// A uniform field but at nodes with conditions, where it is zero.
  [[nodiscard]] Field<NodeId, Vec3> uniform_off_walls(const Vec3& value) const;

 private:
  StokesSolver& solver_;
  StokesProblem problem_;
  KeptPreconditioner& preconditioner_;
  PhaseTimes& times_;
};

/// Liquids on one mesh.
struct MovingLiquids {
  const Scene& scene;
  const TetMesh& mesh;
  const FlowSpace& space;
  const NodePositions& positions;
};
/// ∫ρv dV [μ_out R0²].
[[nodiscard]] Vec3 momentum(const MovingLiquids& liquids, std::span<const Vec3> v);

/// Gives a velocity without divergence a momentum, by the least that three such fields add: what is
/// left of the uniform ones. Where all densities are equal walls hold the momentum, and what
/// differs is the solver's tolerance. Uniform fields off the walls take that away in any case.
[[nodiscard]] std::optional<Fault> keep_momentum(const MovingLiquids& liquids,
                                                 StageProjection& projection, const Vec3& momentum,
                                                 Field<NodeId, Vec3>& v);

/// What a transfer took.
struct MotionLost {
  double momentum = 0.0;  ///< |Δ∫ρv dV| over ∫ρ|v| dV before
  double energy = 0.0;    ///< of ∫½ρv² dV [μ_out G R0³]
};
[[nodiscard]] MotionLost motion_lost(const MovingLiquids& before, std::span<const Vec3> v_before,
                                     const MovingLiquids& after, std::span<const Vec3> v_after);

}  // namespace meniscus::fem
