#pragma once

#include <string>

#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::linear {

/// Whether PETSc was built with hypre.
[[nodiscard]] bool has_hypre();

/// Options, under a prefix, for one cycle of algebraic multigrid for a scalar Laplacian, hypre's or
/// PETSc's own.
[[nodiscard]] std::string multigrid_options(const std::string& prefix, bool is_hypre);

/// Options that make hypre coarsen twice at the finest level: half the set-up time, a tenth more
/// iterations. It pays for GMRES with a triangular preconditioner and a few solves per matrix, not
/// for MINRES.
[[nodiscard]] std::string aggressive_coarsening(const std::string& prefix);

/// The default options of each method, which the user's options override. They are with or without
/// multigrid by degree above the algebraic multigrid, which is hypre's or PETSc's own.
[[nodiscard]] std::string default_options(SaddleMethod method, bool is_by_degree, bool is_hypre);

}  // namespace meniscus::linear
