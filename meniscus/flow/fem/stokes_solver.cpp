#include "meniscus/flow/fem/stokes_solver.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/log.hpp"
#include "meniscus/flow/fem/region_pressures.hpp"
#include "meniscus/flow/fem/solver_steps.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"

namespace meniscus::fem {
namespace {

// A direct solve of more nodes needs over a gigabyte (4.1 GB at 47 000 nodes).
constexpr std::int32_t most_nodes_for_mumps = 20000;
// One for Stokes flow; more where MINRES's norm or a direct solve's roundoff leaves something.
constexpr int most_newton_steps = 6;
// With inertia the velocity that convects is the last step's.
constexpr int most_convection_steps = 20;
constexpr double convection_reduction = 1e-3;

/// The chosen solver, then the others that the elements and their number allow. Quadratic ones have
/// no stabilisation on the diagonal, by which the paper's solver scales. The others need symmetry
/// or matrices, which inertia does not give.
std::vector<LinearSolver> solvers_in_order(LinearSolver first, const StokesProblem& problem) {
  const FlowSpace& space = problem.space;
  if (problem.inertia) return {first};
  const auto is_allowed = [&](LinearSolver next) {
    if (next == LinearSolver::mumps) return space.velocity.num_nodes < most_nodes_for_mumps;
    return next != LinearSolver::paper_gmres || space.elements == Elements::p1_p1;
  };
  std::vector<LinearSolver> order = {first};
  for (const LinearSolver next :
       {LinearSolver::block, LinearSolver::minres, LinearSolver::paper_gmres, LinearSolver::mumps})
    if (next != first && is_allowed(next)) order.push_back(next);
  return order;
}

/// The problem of liquids that keep the viscosity which they have at rest.
StokesProblem with_own_viscosities(const StokesProblem& problem) {
  StokesProblem result = problem;
  result.laws = {};
  return result;
}

linear::SaddleSolver make_linear_solver(LinearSolver which, const Options& options) {
  return {linear::Communicator::of(options.processes),
          {.method = which,
           .max_iterations = options.max_iterations,
           .multigrid_by_degree = options.elements == Elements::p2_p1,
           .petsc_options = options.petsc_options}};
}

/// −∫ψ∇·v of a velocity, and nothing of its momentum.
StokesResidual divergence(const StokesProblem& problem, const StokesState& state,
                          const StokesProduct* product) {
  StokesResidual result = [&] {
    if (product != nullptr) return residual(problem, state, product);
    // What stabilises linear elements knows of forces and inertia.
    StokesProblem alone(problem.mesh, problem.space, problem.positions);
    alone.partition = problem.partition;
    return residual(alone, {state.v, std::vector<double>(state.p.size())});
  }();
  std::ranges::fill(result.momentum, Vec3::Zero());
  return result;
}

}  // namespace

void check_linear_options(const Options& options) {
  const linear::SaddleSolver unused = make_linear_solver(options.linear, options);
}

StokesSolver::StokesSolver(const FlowSpace& space, const Options& options)
    : options_(options),
      space_(space),
      partition_(make_partition(space, linear::Communicator::of(options.processes))) {}

StokesState StokesSolver::state_at_rest() const { return fem::state_at_rest(space_); }

std::vector<CellId> StokesSolver::cells() const {
  if (partition_) return partition_->global_cell;
  const auto all = ids<CellId>(space_.velocity.num_cells());
  return {all.begin(), all.end()};
}

void StokesSolver::share(StokesState& state) const {
  if (partition_) gather_state(local_part(state, *partition_), *partition_, state);
}

linear::SaddleSolver& StokesSolver::linear_solver(LinearSolver which) {
  const auto found = linear_solvers_.find(which);
  if (found != linear_solvers_.end()) return found->second;
  return linear_solvers_.emplace(which, make_linear_solver(which, options_)).first->second;
}

void StokesSolver::prepare(const StokesProblem& problem, const Field<NodeId, Vec3>& convecting) {
  examine(problem, linear::Preconditioner::fresh);
  StokesState state = state_at_rest();
  if (!convecting.empty()) state.v = convecting;
  const auto prepare_local = [&](const StokesProblem& local, const StokesState& begin) {
    use_product(local, linear::Preconditioner::fresh);
    if (product_ && !convecting.empty()) product_->convect(numbers(begin.v));
    const Linearization about{begin, Linearization::Kind::picard};
    linear_solver(options_.linear)
        .prepare(assembled_system(local, options_.linear, linear::Preconditioner::fresh,
                                  convecting.empty() ? nullptr : &about));
  };
  if (partition_)
    prepare_local(local_part(problem, *partition_), local_part(state, *partition_));
  else
    prepare_local(problem, state);
}

void StokesSolver::examine(const StokesProblem& global, linear::Preconditioner preconditioner) {
  shares_ = constant_pressure_shares(global);
  if (slow_modes_ && preconditioner == linear::Preconditioner::kept) return;
  slow_modes_ = slow_modes(global);
  if (partition_) slow_modes_ = local_part(*slow_modes_, *partition_);
}

/// The weights of residuals are kept with the preconditioner.
void StokesSolver::use_product(const StokesProblem& problem,
                               linear::Preconditioner preconditioner) {
  product_.reset();
  if (has_product(problem)) product_.emplace(problem);
  if (preconditioner == linear::Preconditioner::fresh || weights_.empty())
    weights_ = residual_weights(problem);
}

/// The system that a linear solver takes: its products where it can do with them, else matrices.
linear::SaddleSystem StokesSolver::assembled_system(const StokesProblem& problem,
                                                    LinearSolver which,
                                                    linear::Preconditioner preconditioner,
                                                    const Linearization* about) {
  const auto assembled = [&](auto& jacobian, const auto&... of) {
    if (!jacobian) jacobian.emplace(partition_ ? partition_->space : space_, partition_.get());
    jacobian->weigh_constant_pressures(shares_);
    jacobian->assemble(problem, of...);
    linear::SaddleSystem system = jacobian->system();
    system.slow_velocities = slow_modes_->velocities.view();
    system.slow_pressures = slow_modes_->pressures.view();
    system.residual_weights = weights_;
    return system;
  };
  if (product_ && (which == LinearSolver::block || which == LinearSolver::minres))
    return assembled(product_jacobian_, *product_, preconditioner);
  return assembled(jacobian_, about);
}

StokesReport StokesSolver::solve(const StokesProblem& problem, StokesState& state,
                                 linear::Preconditioner preconditioner, PhaseTimes& times) {
  problem.constraints.impose(state.v);
  examine(problem, preconditioner);
  if (!partition_) return solve_local(problem, state, preconditioner, times);
  StokesState part = local_part(state, *partition_);
  StokesReport report = solve_local(local_part(problem, *partition_), part, preconditioner, times);
  if (report.ok()) gather_state(part, *partition_, state);
  return report;
}

StokesPower StokesSolver::power(const StokesProblem& problem, const StokesState& state) const {
  return partition_ ? fem::power(local_part(problem, *partition_), local_part(state, *partition_))
                    : fem::power(problem, state);
}

StokesReport StokesSolver::solve_local(const StokesProblem& problem, StokesState& state,
                                       linear::Preconditioner preconditioner, PhaseTimes& times) {
  if (problem.is_generalised() && problem.inertia)
    return solve_generalised_with_inertia(problem, state, preconditioner, times);
  double reference = 0.0;
  {
    const PhaseTimer timer(times, "assemble");
    use_product(problem, preconditioner);
    reference = reference_residual(problem, product(), weights_);
  }
  StokesReport report;
  report.reference = reference;
  if (!std::isfinite(reference)) {
    report.fault = Fault{FaultKind::not_finite, "the data of the flow problem are not finite"};
    return report;
  }
  if (problem.is_generalised()) {
    report = solve_generalised(problem, state, reference, times);
    if (report.ok()) report.power = fem::power(problem, state);
    return report;
  }
  StokesReport before;  // of the solvers that failed
  std::vector<LinearSolver> order = solvers_in_order(options_.linear, problem);
  if (preconditioner == linear::Preconditioner::kept) order.insert(order.begin(), order.front());
  for (const LinearSolver which : order) {
    StokesState attempt = state;
    report = solve_with(which, problem, attempt, reference, preconditioner, times);
    preconditioner = linear::Preconditioner::fresh;
    report.iterations += before.iterations;
    report.setup_seconds += before.setup_seconds;
    report.krylov_seconds += before.krylov_seconds;
    report.failed_solvers = before.failed_solvers;
    if (report.ok()) {
      state = std::move(attempt);
      return report;
    }
    before = report;
    before.failed_solvers.push_back(
        fmt::format("linear solver {}: {}", linear::name(which), report.text()));
    log::warning("{}; trying another way", before.failed_solvers.back());
  }
  return report;
}

StokesReport StokesSolver::project(const StokesProblem& problem, Field<NodeId, Vec3>& v,
                                   linear::Preconditioner preconditioner, PhaseTimes& times) {
  examine(problem, preconditioner);
  StokesState state = state_at_rest();
  state.v = v;
  problem.constraints.impose(state.v);
  StokesReport report;
  if (!partition_) {
    report = project_local(problem, state, preconditioner, times);
  } else {
    StokesState part = local_part(state, *partition_);
    report = project_local(local_part(problem, *partition_), part, preconditioner, times);
    if (report.ok()) gather_state(part, *partition_, state);
  }
  if (report.ok()) v = std::move(state.v);
  return report;
}

/// One step from the velocity given, where only the continuity leaves a residual.
StokesReport StokesSolver::project_local(const StokesProblem& problem, StokesState& state,
                                         linear::Preconditioner preconditioner, PhaseTimes& times) {
  if (problem.is_generalised())
    return project_local(with_own_viscosities(problem), state, preconditioner, times);
  StokesReport report;
  report.solver = options_.linear;
  std::optional<linear::SaddleSystem> system;
  StokesResidual now;
  {
    const PhaseTimer timer(times, "assemble");
    use_product(problem, preconditioner);
    report.reference = reference_residual(problem, product(), weights_);
    now = divergence(problem, state, product());
    report.residual = free_norm(now, problem, weights_);
    if (report.residual <= options_.rtol * report.reference) return report;
    system = assembled_system(problem, options_.linear, preconditioner, nullptr);
  }
  const PhaseTimer timer(times, "solve");
  const std::vector<double> right = right_hand_side(now, problem);
  std::vector<double> step(right.size());
  const linear::LinearReport linear_report =
      linear_solver(options_.linear)
          .solve(*system, right, step, options_.rtol * report.reference / report.residual,
                 preconditioner);
  add_cost(report, linear_report);
  if (linear_report.converged)
    add_step(state, problem, step);
  else
    report.fault = Fault{FaultKind::not_converged, linear_report.reason};
  return report;
}

StokesReport StokesSolver::solve_with(LinearSolver which, const StokesProblem& problem,
                                      StokesState& state, double reference,
                                      linear::Preconditioner preconditioner, PhaseTimes& times) {
  StokesReport report;
  report.solver = which;
  report.reference = reference;
  const double target = options_.rtol * reference;
  const OwnedCounts owned = owned_counts(problem);
  std::vector<double> step(3 * static_cast<std::size_t>(owned.num_nodes) +
                           static_cast<std::size_t>(owned.num_pressures));
  std::optional<linear::SaddleSystem> system;
  const int most_steps = problem.inertia ? most_convection_steps : most_newton_steps;
  const Linearization about{state, Linearization::Kind::picard};
  for (; report.newton_steps <= most_steps; ++report.newton_steps) {
    if (product_) product_->convect(numbers(state.v));
    const StokesResidual now = residual(problem, state, product());
    report.residual = free_norm(now, problem, weights_);
    // 2: the residual that a Krylov method updates and the true one differ by roundoff. A first
    // guess has no such excuse.
    if (report.residual <= (report.newton_steps == 0 ? 1.0 : 2.0) * target) {
      report.power = fem::power(problem, state, product(), now);
      return report;
    }
    if (report.newton_steps == most_steps) break;
    if (!system) {
      const PhaseTimer timer(times, "assemble");
      system = assembled_system(problem, which, preconditioner, problem.inertia ? &about : nullptr);
    }
    const PhaseTimer timer(times, "solve");
    std::ranges::fill(step, 0.0);
    // What convects is the last velocity: a more exact solution would not be a better one.
    const double rtol =
        std::max(target / report.residual, problem.inertia ? convection_reduction : 0.0);
    const linear::LinearReport linear_report = linear_solver(which).solve(
        *system, right_hand_side(now, problem), step, rtol, preconditioner);
    add_cost(report, linear_report);
    report.linear_residuals = linear_report.residuals;
    if (!linear_report.converged) {
      report.fault = Fault{FaultKind::not_converged, linear_report.reason};
      return report;
    }
    add_step(state, problem, step);
    preconditioner = linear::Preconditioner::kept;
  }
  report.fault =
      Fault{FaultKind::not_converged, fmt::format("residual {:.1e} of {:.1e} after {} steps",
                                                  report.residual, reference, most_steps)};
  return report;
}

bool StokesSolver::linear_step(const StokesProblem& problem, const StokesResidual& now,
                               const Linearization* about, double rtol, PhaseTimes& times,
                               StokesState& step, StokesReport& report) {
  const linear::SaddleSystem system = [&] {
    const PhaseTimer timer(times, "assemble");
    return assembled_system(problem, options_.linear, linear::Preconditioner::fresh, about);
  }();
  const PhaseTimer timer(times, "solve");
  const std::vector<double> right = right_hand_side(now, problem);
  std::vector<double> values(right.size());
  for (const LinearSolver which : solvers_in_order(report.solver, problem)) {
    std::ranges::fill(values, 0.0);
    const linear::LinearReport linear_report =
        linear_solver(which).solve(system, right, values, rtol, linear::Preconditioner::fresh);
    add_cost(report, linear_report);
    report.linear_residuals = linear_report.residuals;
    if (linear_report.converged) {
      report.solver = which;  // and first to be asked in the next step
      step = fem::state_at_rest(problem.space);
      add_step(step, problem, values);
      return true;
    }
    report.failed_solvers.push_back(
        fmt::format("linear solver {}: {}", linear::name(which), linear_report.reason));
    log::warning("{}; trying another way", report.failed_solvers.back());
  }
  return false;
}

}  // namespace meniscus::fem
