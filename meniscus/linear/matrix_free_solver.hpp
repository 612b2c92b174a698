#pragma once

#include <span>

#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::linear {

struct MatrixFreeOptions {
  double rtol = 1e-8;  ///< relative to the norm of the right-hand side
  int max_iterations = 200;
  int restart = 60;
};

/// Solves A x = b by GMRES. `solution` holds the initial guess and then the result.
LinearReport solve_matrix_free(const LinearOperator& matrix,
                               std::span<const double> right_hand_side, std::span<double> solution,
                               const MatrixFreeOptions& options);

}  // namespace meniscus::linear
