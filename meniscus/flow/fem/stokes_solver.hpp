#pragma once

#include <map>

#include "meniscus/core/timer.hpp"
#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/fem/spaces.hpp"
#include "meniscus/flow/fem/stokes_jacobian.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::fem {

/// Throws InvalidInput when PETSc cannot read the options given for the linear solver.
void check_linear_options(const Options& options);

struct [[nodiscard]] StokesReport {
  bool ok = true;
  std::string failure;
  int iterations = 0;  ///< linear iterations of all steps and all solvers tried
  int newton_steps = 0;
  double reference = 0.0;                     ///< residual of the state that rests wherever it may
  double residual = 0.0;                      ///< left over
  LinearSolver solver = LinearSolver::block;  ///< the one that gave the answer
  std::vector<double> linear_residuals;       ///< of its last solve
  std::vector<std::string> failed_solvers;    ///< each with its reason, before that one
};

/// Solves R(u) = 0 by Newton's method, J δ = −R (eq. 13 of hooper2001), on one space, which
/// must outlive it. The positions of the nodes may change between solves. Stokes flow takes one
/// step, and another where a linear solver's own norm was content too early.
class StokesSolver {
 public:
  StokesSolver(const FlowSpace& space, const Options& options);

  [[nodiscard]] StokesState state_at_rest() const;

  /// Makes and keeps the preconditioner that a fresh solve of this problem would make.
  void prepare(const StokesProblem& problem);

  /// Improves `state` until the residual is below rtol times the reference: that of the state which
  /// rests wherever it may. Where the chosen linear solver fails it is tried again with a fresh
  /// preconditioner, if it had a kept one, and then the others in the order block, minres,
  /// paper-gmres, mumps (mumps below 20 000 nodes); on failure of all `state` is unchanged but
  /// for the imposed velocities.
  StokesReport solve(const StokesProblem& problem, StokesState& state,
                     linear::Preconditioner preconditioner, PhaseTimes& times);

 private:
  StokesReport solve_with(LinearSolver which, const StokesProblem& problem, StokesState& state,
                          double reference, linear::Preconditioner preconditioner,
                          PhaseTimes& times);
  linear::SaddleSolver& linear_solver(LinearSolver which);

  Options options_;
  const FlowSpace& space_;
  StokesJacobian jacobian_;
  std::map<LinearSolver, linear::SaddleSolver> linear_solvers_;
};

}  // namespace meniscus::fem
