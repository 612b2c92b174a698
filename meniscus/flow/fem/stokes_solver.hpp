#pragma once

#include <map>
#include <optional>

#include "meniscus/core/fault.hpp"
#include "meniscus/core/timer.hpp"
#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/flow/fem/product_jacobian.hpp"
#include "meniscus/flow/fem/slow_modes.hpp"
#include "meniscus/flow/fem/spaces.hpp"
#include "meniscus/flow/fem/stokes_jacobian.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::fem {

/// Throws InvalidInput when PETSc cannot read the options given for the linear solver.
void check_linear_options(const Options& options);

struct [[nodiscard]] StokesReport : Report {
  int iterations = 0;  ///< linear iterations of all steps and all solvers tried
  int newton_steps = 0;
  int picard_steps = 0;    ///< those of generalised-Newtonian liquids with the viscosity held fixed
  double reference = 0.0;  ///< residual that the tolerance is relative to (StokesSolver::solve)
  double residual = 0.0;   ///< left over
  LinearSolver solver = LinearSolver::block;  ///< the one that gave the answer
  std::vector<double> linear_residuals;       ///< of its last solve
  std::vector<std::string> failed_solvers;    ///< each with its reason, before that one
  /// Processor time of this process in making preconditioners and in iterating, of all.
  double setup_seconds = 0.0, krylov_seconds = 0.0;
  std::vector<double> residuals;  ///< with laws of viscosity: before each step, and at last
  StokesPower power;              ///< the energy balance of a solution
};

/// Solves R(u) = 0 by Newton's method, J δ = −R (eq. 13 of hooper2001), on one space, which
/// must outlive it. The positions of the nodes may change between solves. Stokes flow takes one
/// step, and another where a linear solver's own norm was content too early; generalised-Newtonian
/// liquids take several, as docs/generalised-newtonian.md says. With inertia these are Picard's.
class StokesSolver {
 public:
  /// With several processes all calls are collective: each process gives the same global space and
  /// problem, and gets the same result.
  StokesSolver(const FlowSpace& space, const Options& options);

  [[nodiscard]] StokesState state_at_rest() const;

  /// The cells around the nodes that this process owns; all of them where there is one process.
  [[nodiscard]] std::vector<CellId> cells() const;
  /// Gives every process the values that the others have at the nodes they own. Collective.
  void share(StokesState& state) const;

  /// Makes and keeps the preconditioner that a fresh solve of this problem would make, or a
  /// projection by it. With inertia `convecting` is the velocity past the mesh that the solve would
  /// begin with, the problem's mesh being at rest; empty: a projection's, which has none.
  void prepare(const StokesProblem& problem, const Field<NodeId, Vec3>& convecting = {});
  /// Whether the velocity that convects matters to the preconditioner: it has slow velocities,
  /// whose coarse operator is made of products.
  [[nodiscard]] bool has_slow_velocities() const {
    return slow_modes_ && slow_modes_->velocities.row_start.size() > 1;
  }

  /// Improves `state` until the residual is below rtol times the reference, in the norm of
  /// `free_norm` by `residual_weights`. That is the residual of
  /// the state which rests wherever it may. It is 50 times that of the problem's undisturbed flow,
  /// if it has one and that is less. Where the chosen linear solver fails it is tried again with a
  /// fresh preconditioner, if it had a kept one. Then come the others in the order block, minres,
  /// paper-gmres, mumps (mumps below 20 000 nodes). On failure of all `state` is unchanged but for
  /// the imposed velocities.
  StokesReport solve(const StokesProblem& problem, StokesState& state,
                     linear::Preconditioner preconditioner, PhaseTimes& times);

  /// Takes from `v` the least, by the matrix of the problem without convection, that leaves it
  /// without divergence and with the imposed velocities. The preconditioner is that of `solve`.
  StokesReport project(const StokesProblem& problem, Field<NodeId, Vec3>& v,
                       linear::Preconditioner preconditioner, PhaseTimes& times);

  /// The energy balance of a solution.
  [[nodiscard]] StokesPower power(const StokesProblem& problem, const StokesState& state) const;

 private:
  void use_product(const StokesProblem& problem, linear::Preconditioner preconditioner);
  /// Null where there is none.
  [[nodiscard]] const StokesProduct* product() const { return product_ ? &*product_ : nullptr; }
  /// Finds what preconditioners get from the global problem.
  void examine(const StokesProblem& global, linear::Preconditioner preconditioner);
  linear::SaddleSystem assembled_system(const StokesProblem& problem, LinearSolver which,
                                        linear::Preconditioner preconditioner,
                                        const Linearization* about);
  StokesReport project_local(const StokesProblem& problem, StokesState& state,
                             linear::Preconditioner preconditioner, PhaseTimes& times);
  StokesReport solve_local(const StokesProblem& problem, StokesState& state,
                           linear::Preconditioner preconditioner, PhaseTimes& times);
  StokesReport solve_with(LinearSolver which, const StokesProblem& problem, StokesState& state,
                          double reference, linear::Preconditioner preconditioner,
                          PhaseTimes& times);
  StokesReport solve_generalised(const StokesProblem& problem, StokesState& state, double reference,
                                 PhaseTimes& times);
  StokesReport solve_generalised_with_inertia(const StokesProblem& problem, StokesState& state,
                                              linear::Preconditioner preconditioner,
                                              PhaseTimes& times);
  /// One step of a generalised solve: linearises, solves to `rtol`, gives δ without the fixed
  /// components.
  [[nodiscard]] bool linear_step(const StokesProblem& problem, const StokesResidual& now,
                                 const Linearization* about, double rtol, PhaseTimes& times,
                                 StokesState& step, StokesReport& report);
  linear::SaddleSolver& linear_solver(LinearSolver which);

  Options options_;
  const FlowSpace& space_;
  std::unique_ptr<const Partition> partition_;  ///< this rank's; null on one rank
  Field<RegionId, double> shares_;              ///< of the problem, as below (region_pressures.hpp)
  std::optional<SlowModes> slow_modes_;   ///< this rank's, since a fresh preconditioner last asked
  std::optional<StokesProduct> product_;  ///< of the problem that is being solved, if it has one
  std::vector<double> weights_;           ///< of its residual (`residual_weights`)
  std::optional<StokesJacobian> jacobian_;  ///< made when a solver first takes matrices
  std::optional<ProductJacobian> product_jacobian_;
  std::map<LinearSolver, linear::SaddleSolver> linear_solvers_;
};

}  // namespace meniscus::fem
