#pragma once

#include <vector>

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// R(u) of eqs 10 and 11, by cells, before any condition is imposed: where v is fixed, `momentum`
/// is the force that the boundary exerts on the fluid.
struct StokesResidual {
  Field<NodeId, Vec3> momentum;    ///< [μ_out G R0²]
  std::vector<double> continuity;  ///< [G R0³]
};
[[nodiscard]] StokesResidual residual(const StokesProblem& problem, const StokesState& state);
/// Euclidean norm of what a solution must make zero: the residual without its fixed components; of
/// the whole where ranks have a part each (collective).
[[nodiscard]] double free_norm(const StokesResidual& residual, const StokesProblem& problem);

/// The terms of the energy balance of a solution [μ_out G² R0³]. Exactly, up to the solver's
/// residual, reaction + body_force + load = dissipation.
struct StokesPower {
  double reaction = 0.0;     ///< of the fixed velocity components
  double body_force = 0.0;   ///< ∫f·v
  double load = 0.0;         ///< Σ load_i·v_i
  double dissipation = 0.0;  ///< ∫2μ D:D + Σ τ∫∇p·(∇p − f)
};
/// Of the whole where ranks have a part each (collective).
[[nodiscard]] StokesPower power(const StokesProblem& problem, const StokesState& state);

}  // namespace meniscus::fem
