#pragma once

#include <memory>
#include <span>

#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::linear {

/// What a scalar system is like.
enum class ScalarSystem {
  transport,   ///< mass and convection outweigh conduction: GMRES with Gauss–Seidel
  conduction,  ///< conduction outweighs: GMRES with one cycle of algebraic multigrid
  potential    ///< symmetric, perhaps singular: conjugate gradients with symmetric Gauss–Seidel
};

/// Solves systems with one sparse matrix on this process alone. Processes that solve the same
/// system get the same bits.
class TransportSolver {
 public:
  /// Makes the preconditioner. The arrays of the matrix must outlive this; when their values change
  /// later, solves take the new values and keep the preconditioner.
  TransportSolver(const CsrView& matrix, ScalarSystem kind);
  ~TransportSolver();
  TransportSolver(const TransportSolver&) = delete;
  TransportSolver& operator=(const TransportSolver&) = delete;

  /// Starts from `solution` and stops when the residual is `rtol` times the norm of the right-hand
  /// side. After `max_iterations` the last iterate is in `solution`.
  LinearReport solve(std::span<const double> right_hand_side, std::span<double> solution,
                     double rtol, int max_iterations) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meniscus::linear
