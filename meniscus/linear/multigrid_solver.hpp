#pragma once

#include <memory>
#include <span>

#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::linear {

/// Solves systems with one scalar elliptic matrix (symmetric positive definite) on this process
/// alone, by conjugate gradients preconditioned with one cycle of algebraic multigrid. The number
/// of iterations hardly grows with the number of rows. Processes that solve the same system get the
/// same bits.
class MultigridSolver {
 public:
  /// Sets the multigrid up. The arrays of the matrix must outlive this.
  explicit MultigridSolver(const CsrView& matrix);
  ~MultigridSolver();
  MultigridSolver(const MultigridSolver&) = delete;
  MultigridSolver& operator=(const MultigridSolver&) = delete;

  /// Starts from zero and stops when the residual is `rtol` times the norm of the right-hand side.
  /// After `max_iterations` the last iterate is in `solution`.
  LinearReport solve(std::span<const double> right_hand_side, std::span<double> solution,
                     double rtol, int max_iterations) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meniscus::linear
