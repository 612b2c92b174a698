#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/fem/stokes_product.hpp"

namespace meniscus::fem {

/// R(u) of eqs 10 and 11, by cells, before any condition is imposed. Where v is fixed, `momentum`
/// is the force that the boundary exerts on the fluid.
struct StokesResidual {
  Field<NodeId, Vec3> momentum;    ///< [μ_out G R0²]
  std::vector<double> continuity;  ///< [G R0³]
};
/// By `product`, the problem's own, where it is given. With inertia of quadratic elements it must
/// be. It counts the convection by the velocity that it was told, if any. Where viscosities depend
/// on the rate of shear it gives what inertia adds, and nothing else. On linear elements the
/// state's velocity convects.
[[nodiscard]] StokesResidual residual(const StokesProblem& problem, const StokesState& state,
                                      const StokesProduct* product = nullptr);
/// That of a state that is zero in most cells, at less cost.
[[nodiscard]] StokesResidual residual_near_rest(const StokesProblem& problem,
                                                const StokesState& state,
                                                const StokesProduct* product);
/// What the owned entries of a residual count: three for each node, then one for each pressure.
/// They are d^(−½), d near the diagonals of ∫2μ D:D and of the lumped ∫ψψ/μ. In the plain norm the
/// force on a node counts in proportion to its cells' size. Large cells far from the drops then
/// hide errors beside them, above all in the divergence. The weighted norm is at most of the order
/// of the error's energy; errors that are smooth count less. For problems without inertia that have
/// a product; else empty.
[[nodiscard]] std::vector<double> residual_weights(const StokesProblem& problem);
/// Norm of what a solution must make zero: the residual without its fixed components, by weights or
/// all alike where there are none. The norm is the global one; collective on the ranks of a
/// partitioned problem.
[[nodiscard]] double free_norm(const StokesResidual& residual, const StokesProblem& problem,
                               std::span<const double> weights = {});

/// The terms of the energy balance of a solution [μ_out G² R0³]. Up to the solver's residual and
/// the implicit part of tension, reaction + body_force + force = dissipation + kinetic_rate.
struct StokesPower {
  double reaction = 0.0;      ///< of the fixed velocity components
  double body_force = 0.0;    ///< ∫f·v
  double force = 0.0;         ///< Σ F_i·v_i of the forces by node
  double dissipation = 0.0;   ///< ∫2μ D:D + Σ τ∫∇p·(ρDv/Dt + ∇p − f)
  double kinetic_rate = 0.0;  ///< ∫ρ v·Dv/Dt
};
/// The global energy balance; collective on the ranks of a partitioned problem. By `product`, the
/// problem's own, told that the state's velocity convects, where it is given.
[[nodiscard]] StokesPower power(const StokesProblem& problem, const StokesState& state,
                                const StokesProduct* product = nullptr);
/// The same, where the state's residual is known.
[[nodiscard]] StokesPower power(const StokesProblem& problem, const StokesState& state,
                                const StokesProduct* product, const StokesResidual& of_state);

}  // namespace meniscus::fem
