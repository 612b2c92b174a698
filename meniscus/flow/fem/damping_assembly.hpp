#pragma once

#include <span>

#include "meniscus/flow/fem/cell_assembly.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// Adds n_i K_ij n_jᵀ of the problem's damping to A, and a third of its trace to the scalar
/// Laplacians that stand for A in preconditioners. Damped nodes are free ones. `graph` is the
/// velocity's, columns numbered as the partition says.
void add_damping(const StokesProblem& problem, const NodeGraph& graph, StokesValues& values,
                 std::span<ScalarLaplacian> laplacians);

}  // namespace meniscus::fem
