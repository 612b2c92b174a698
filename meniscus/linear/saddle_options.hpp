#pragma once

#include <string>

#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::linear {

/// Whether PETSc was built with hypre.
[[nodiscard]] bool has_hypre();

/// One cycle of algebraic multigrid for a scalar Laplacian, hypre's or PETSc's own, as options
/// under a prefix.
[[nodiscard]] std::string multigrid_options(const std::string& prefix, bool is_hypre);

/// Makes hypre's coarsen twice at the finest level: half the set-up and a tenth of the iterations
/// more, which GMRES with a triangular preconditioner and a few solves with one matrix gain from
/// and MINRES does not.
[[nodiscard]] std::string aggressive_coarsening(const std::string& prefix);

/// The choices of each method, as options that the user's own may override: with a multigrid by
/// degree over the algebraic one or without, the latter hypre's or PETSc's own.
[[nodiscard]] std::string default_options(SaddleMethod method, bool is_by_degree, bool is_hypre);

}  // namespace meniscus::linear
