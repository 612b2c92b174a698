#pragma once

#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::fem {

/// Functions that the blocks of preconditioners do not know well, as rows. Velocities have three
/// columns for each node, pressures one each.
struct SlowModes {
  linear::CsrMatrix velocities, pressures;
};

/// The slow modes of a global problem, from the sections of its drops.
///
/// A drop much more viscous than the liquid around resists little where it turns or bends. Its
/// sections move as rigid bodies, where ∫2μ D:D is zero and the Laplacian, ∫μ|∇v|², is not. They
/// move in six ways each, with the liquid around, but for the nodes whose velocity is given.
///
/// In a drop much less viscous, a pressure that varies only along its length has to move the liquid
/// around or to pass a neck. It drives less flow than its mass over μ says. Such pressures are the
/// sections' weights. For a drop of one section that is `constant_pressure_shares`. A pressure that
/// varies along any axis accelerates such a drop, as far as the matrix gives way. The
/// matrix holds it in long implicit stages: ρR²/τ ≤ 10 μ_out of drop and matrix. There the weights'
/// products with the coordinates come to it. In Stokes flow these save no more than they cost.
///
/// More than eight such drops have none, as each function takes a product with the whole matrix.
[[nodiscard]] SlowModes slow_modes(const StokesProblem& problem);

/// The columns that this rank owns.
[[nodiscard]] SlowModes local_part(const SlowModes& global, const Partition& partition);

}  // namespace meniscus::fem
