#include "meniscus/flow/fem/solver_steps.hpp"

#include <algorithm>

#include "meniscus/flow/fem/constants.hpp"

namespace meniscus::fem {
namespace {

/// A velocity without pressure, once the fixed velocities are imposed.
StokesState without_pressure(const StokesProblem& problem, Field<NodeId, Vec3> v) {
  StokesState state{std::move(v), std::vector<double>(problem.space.pressure.vertex.size(), 0.0)};
  problem.constraints.impose(state.v);
  return state;
}

}  // namespace

void add_cost(StokesReport& report, const linear::LinearReport& linear_report) {
  report.iterations += linear_report.iterations;
  report.setup_seconds += linear_report.setup_seconds;
  report.krylov_seconds += linear_report.solve_seconds;
}

std::vector<double> right_hand_side(const StokesResidual& residual, const StokesProblem& problem) {
  const OwnedCounts owned = owned_counts(problem);
  std::vector<double> values;
  values.reserve(3 * static_cast<std::size_t>(owned.num_nodes) +
                 static_cast<std::size_t>(owned.num_pressures));
  for (const NodeId i : ids<NodeId>(owned.num_nodes)) {
    const Vec3& r = residual.momentum[i];
    values.insert(values.end(), {-r[0], -r[1], -r[2]});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(owned.num_pressures); ++i)
    values.push_back(-residual.continuity[i]);
  for (const NodeConstraint& constraint : problem.constraints.all()) {
    if (constraint.node.value >= owned.num_nodes) continue;
    const Vec3 local = constraint.frame.transpose() * residual.momentum[constraint.node];
    for (std::size_t k = 0; k < 3; ++k)
      values[3 * static_cast<std::size_t>(constraint.node.value) + k] =
          constraint.is_fixed[k] ? 0.0 : -local[static_cast<Eigen::Index>(k)];
  }
  return values;
}

void add_step(StokesState& state, const StokesProblem& problem,
              std::span<const double> owned_step) {
  std::vector<double> local;
  if (problem.partition != nullptr) local = with_ghosts(owned_step, *problem.partition);
  const std::span<const double> step = problem.partition != nullptr ? local : owned_step;
  const Constraints& constraints = problem.constraints;
  const auto step_at = [&](NodeId i) {
    const std::size_t k = 3 * static_cast<std::size_t>(i.value);
    return Vec3(step[k], step[k + 1], step[k + 2]);
  };
  for (const NodeId i : state.v.ids()) {
    const NodeConstraint* constraint = constraints.find(i);
    if (constraint == nullptr) state.v[i] += step_at(i);
    if (constraint == nullptr) continue;
    const Vec3 moved = constraint->frame * step_at(i);
    state.v[i] += moved - constraint->fixed_part(moved);
  }
  const std::size_t first = 3 * static_cast<std::size_t>(state.v.size());
  for (std::size_t i = 0; i < state.p.size(); ++i) state.p[i] += step[first + i];
}

double reference_residual(const StokesProblem& problem, const StokesProduct* product,
                          std::span<const double> weights) {
  const StokesState rest = without_pressure(problem, state_at_rest(problem.space).v);
  const double at_rest = free_norm(residual_near_rest(problem, rest, product), problem, weights);
  if (problem.undisturbed.empty()) return at_rest;
  const StokesState flow = without_pressure(problem, problem.undisturbed);
  const double undisturbed = free_norm(residual(problem, flow, product), problem, weights);
  return std::clamp(kMostOfDisturbance * undisturbed, kLeastOfRest * at_rest, at_rest);
}

}  // namespace meniscus::fem
