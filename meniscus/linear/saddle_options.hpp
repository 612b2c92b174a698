#pragma once

#include <string>

#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::linear {

/// Whether PETSc was built with hypre.
[[nodiscard]] bool has_hypre();

/// The choices of each method, as options that the user's own may override: with a multigrid by
/// degree over the algebraic one or without, the latter hypre's or PETSc's own.
[[nodiscard]] std::string default_options(SaddleMethod method, bool is_by_degree, bool is_hypre);

}  // namespace meniscus::linear
