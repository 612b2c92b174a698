// Generalised-Newtonian liquids: Newton's method, helped by Picard's
// (docs/generalised-newtonian.md).
#include <algorithm>
#include <cmath>
#include <limits>

#include "meniscus/core/log.hpp"
#include "meniscus/flow/fem/cell_state.hpp"
#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/solver_steps.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"

namespace meniscus::fem {
namespace {

using Kind = Linearization::Kind;

// Newton's method takes five or six from a cold start. A power law of index 0.2 that it cannot take
// contracts by 0.8 with each of Picard's.
constexpr int most_steps = 80;
// A state whose residual is this part of that of rest knows nothing of the flow yet.
constexpr double cold = 0.1;
// Steps of Picard's method after a cold start, and after a failure of Newton's.
constexpr int picard_steps_at_first = 2, picard_steps_as_help = 3;
// Loosest relative residual of a linear solve: a Krylov method gets there in a few iterations.
constexpr double loosest = 1e-2;
// Halvings of a step that does not lower the residual.
constexpr int most_halvings = 6;
// The decrease asked for, as a part of what a linear problem would give (dennis1983, sec. 6.3).
constexpr double sufficient = 1e-4;

StokesState state_along(const StokesState& state, double length, const StokesState& step) {
  StokesState result = state;
  for (const NodeId i : result.v.ids()) result.v[i] += length * step.v[i];
  for (std::size_t i = 0; i < result.p.size(); ++i) result.p[i] += length * step.p[i];
  return result;
}

/// A state with its residual.
struct Iterate {
  StokesState state;
  StokesResidual residual;
  double norm = std::numeric_limits<double>::infinity();

  Iterate(const StokesProblem& problem, StokesState at)
      : state(std::move(at)), residual(fem::residual(problem, state)) {
    const double found = free_norm(residual, problem);
    if (std::isfinite(found)) norm = found;
  }
};

/// The state at the longest of the lengths 1, ½, ¼, … of a step that lowers the residual, or the
/// best of those tried.
Iterate search(const StokesProblem& problem, const Iterate& from, const StokesState& step) {
  double length = 1.0;
  Iterate best(problem, state_along(from.state, length, step));
  for (int k = 0; k < most_halvings && best.norm > (1.0 - sufficient * length) * from.norm; ++k) {
    length *= 0.5;
    Iterate next(problem, state_along(from.state, length, step));
    if (next.norm < best.norm) best = std::move(next);
  }
  return best;
}

/// The relative tolerance of a linear solve, no tighter than the last step needs. It is as loose as
/// the quadratic convergence of Newton's method allows (dembo1982: of the order of the residual).
double linear_tolerance(double norm, double reference, double target) {
  return std::max(std::min(loosest, norm / reference), 0.5 * target / norm);
}

// With inertia: steps at most, and the relative residual of the linear solve of each. A solve
// lowers that of a liquid that thins by no more than its law bends.
constexpr int most_steps_with_inertia = 60;
constexpr double reduction_with_inertia = 0.05;

/// The mean of the viscosity over each cell, at a state.
CellField<double> mean_viscosities(const StokesProblem& problem, const StokesState& state) {
  CellField<double> means = problem.viscosity;
  with_element(problem.space, problem.positions, [&](auto& element) {
    using Element = std::remove_reference_t<decltype(element)>;
    for (const CellId c : problem.mesh.cells.ids()) {
      if (problem.law(c) == nullptr) continue;
      const CellState<Element> cell(problem.space, state, c);
      double sum = 0.0, volume = 0.0;
      for (const auto& point : element.points(c)) {
        sum += point.weight * viscosity_at(problem, c, cell.velocity_gradient(point));
        volume += point.weight;
      }
      means[c] = sum / volume;
    }
  });
  return means;
}

std::string text_of(const std::vector<double>& residuals, double reference) {
  std::string text;
  for (const double residual : residuals) text += fmt::format(" {:.1e}", residual / reference);
  return text;
}

}  // namespace

StokesReport StokesSolver::solve_generalised(const StokesProblem& problem, StokesState& state,
                                             double reference, PhaseTimes& times) {
  StokesReport report;
  report.solver = options_.linear;
  report.reference = reference;
  const double target = options_.rtol * reference;
  Iterate at(problem, state);
  StokesState step;
  const auto fail = [&](std::string_view why) {
    report.fault =
        Fault{FaultKind::not_converged, fmt::format("{}; residuals of the {} steps:{}", why,
                                                    report.newton_steps + report.picard_steps,
                                                    text_of(report.residuals, reference))};
    return report;
  };

  // The flow of liquids that keep their own viscosity is where a cold start begins.
  int picard_left = 0;
  if (at.norm > cold * reference) {
    StokesProblem newtonian = problem;
    newtonian.laws = {};
    if (!linear_step(newtonian, residual(newtonian, state), nullptr, loosest, times, step, report))
      return fail("no linear solver converged");
    at = Iterate(problem, state_along(state, 1.0, step));
    picard_left = picard_steps_at_first;
  }
  for (;;) {
    report.residuals.push_back(at.norm);
    report.residual = at.norm;
    if (at.norm <= (report.residuals.size() == 1 ? 1.0 : 2.0) * target) break;
    if (report.newton_steps + report.picard_steps >= most_steps)
      return fail("the viscosity's iteration does not converge");
    const Linearization about{at.state, picard_left > 0 ? Kind::picard : Kind::newton};
    const double rtol = linear_tolerance(at.norm, reference, target);
    if (!linear_step(problem, at.residual, &about, rtol, times, step, report))
      return fail("no linear solver converged");
    Iterate next = search(problem, at, step);
    const bool is_newton = about.kind == Kind::newton;
    log::debug("{} step: residual {:.2e} to {:.2e} of the reference",
               is_newton ? "newton" : "picard", at.norm / reference, next.norm / reference);
    ++(is_newton ? report.newton_steps : report.picard_steps);
    if (is_newton && next.norm >= at.norm) {
      picard_left = picard_steps_as_help;  // from where it stands
      continue;
    }
    // Picard's steps lower an energy, not always the residual: they are taken in any case.
    if (!std::isfinite(next.norm)) return fail("the residual is not finite");
    if (!is_newton) --picard_left;
    at = std::move(next);
  }
  state = std::move(at.state);
  return report;
}

/// Picard's method: the viscosity of each cell is held at its mean in the last state, as the
/// velocity that convects is the last one. The residual is that of the true viscosities.
StokesReport StokesSolver::solve_generalised_with_inertia(const StokesProblem& problem,
                                                          StokesState& state,
                                                          linear::Preconditioner preconditioner,
                                                          PhaseTimes& times) {
  StokesReport report;
  report.solver = options_.linear;
  StokesProblem held = problem;
  held.laws = {};
  std::vector<double> step(3 * static_cast<std::size_t>(owned_counts(problem).num_nodes) +
                           static_cast<std::size_t>(owned_counts(problem).num_pressures));
  const auto fail = [&](std::string why) {
    report.fault = Fault{FaultKind::not_converged, std::move(why)};
    return report;
  };
  for (;; ++report.picard_steps) {
    std::optional<linear::SaddleSystem> system;
    StokesResidual now;
    {
      const PhaseTimer timer(times, "assemble");
      held.viscosity = mean_viscosities(problem, state);
      use_product(held, linear::Preconditioner::fresh);
      if (report.picard_steps == 0) report.reference = reference_residual(problem, product(), {});
      if (!std::isfinite(report.reference))
        return fail("the data of the flow problem are not finite");
      if (product_) product_->convect(numbers(state.v));
      now = residual(problem, state, product());
      report.residual = free_norm(now, problem);
      report.residuals.push_back(report.residual);
      if (!std::isfinite(report.residual)) return fail("the residual is not finite");
      if (report.residual <=
          (report.picard_steps == 0 ? 1.0 : 2.0) * options_.rtol * report.reference)
        break;
      if (report.picard_steps == most_steps_with_inertia)
        return fail(
            fmt::format("the viscosity's iteration does not converge; residuals of the {} "
                        "steps:{}",
                        report.picard_steps, text_of(report.residuals, report.reference)));
      const Linearization about{state, Kind::picard};
      system = assembled_system(held, options_.linear, preconditioner, &about);
    }
    const PhaseTimer timer(times, "solve");
    std::ranges::fill(step, 0.0);
    const double rtol =
        std::max(options_.rtol * report.reference / report.residual, reduction_with_inertia);
    const linear::LinearReport linear_report =
        linear_solver(options_.linear)
            .solve(*system, right_hand_side(now, problem), step, rtol, preconditioner);
    add_cost(report, linear_report);
    report.linear_residuals = linear_report.residuals;
    if (!linear_report.converged) return fail(linear_report.reason);
    add_step(state, problem, step);
    preconditioner = linear::Preconditioner::kept;
  }
  report.power = fem::power(problem, state, product());
  product_.reset();  // of a problem that ends here
  return report;
}

}  // namespace meniscus::fem
