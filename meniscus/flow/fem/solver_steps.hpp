#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/fem/stokes_solver.hpp"

// What every way of solving a Stokes problem does around its linear solves.

namespace meniscus::fem {

/// Adds iterations and times of one linear solve to the report.
void add_cost(StokesReport& report, const linear::LinearReport& linear_report);

/// −R with the fixed components zero, in the frames of the unknowns.
[[nodiscard]] std::vector<double> right_hand_side(const StokesResidual& residual,
                                                  const StokesProblem& problem);

/// Adds δ, given in the frames of the owned unknowns, to the local state. Collective.
void add_step(StokesState& state, const StokesProblem& problem, std::span<const double> owned_step);

/// The residual that the data alone cause where all else rests. A boundary far away has the most of
/// it, in proportion to its distance squared. What counts is what the drops cause, the residual of
/// the undisturbed flow. A boundary at 10 R0 has some 30 to 100 times as much, one at 100 R0 ten
/// thousand times. Of a product that was not told what convects. The norm is that of `free_norm` by
/// the weights.
[[nodiscard]] double reference_residual(const StokesProblem& problem, const StokesProduct* product,
                                        std::span<const double> weights);

}  // namespace meniscus::fem
