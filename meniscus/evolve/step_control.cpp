#include "meniscus/evolve/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/stability.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Bounds of the factor by which an attempt is shortened because of its error.
constexpr double kMostShortening = 0.1, kLeastShortening = 0.8;

void shorten(StepPlan& plan, double dt, StepBound bound) {
  if (dt < plan.dt) plan = {dt, bound};
}

StepPlan paper_plan(const State& state, const EvolutionOptions& options) {
  double shortest = kInfinity, tension = 0.0;
  for (const Interface& interface : state.scene.interfaces) {
    shortest = std::min(shortest, shortest_edge(interface.mesh));
    tension = std::max(tension, interface.tension);
  }
  if (options.step_edges == StepEdges::mesh && state.mesh)
    shortest = std::min(shortest, shortest_edge(state.mesh->tetrahedra()));
  MENISCUS_ASSERT(shortest > 0.0, "an edge of length {:g}", shortest);
  const double capillary = tension > 0.0 ? std::min(1.0, 1.0 / tension) : 1.0;
  StepPlan plan{options.max_step, StepBound::max_step};
  shorten(plan, options.step_factor * capillary * shortest, StepBound::step_factor);
  shorten(plan, longest_stable_step(state.scene, options.scheme), StepBound::stability);
  return plan;
}

/// Whether the step that led to t ended where the imposed flow jumps.
bool is_at_jump(const State& state) {
  return std::ranges::any_of(state.scene.flow.schedule(), [&](const ImposedFlow::Entry& entry) {
    return entry.ramp == 0.0 && entry.time <= state.t && entry.time > state.t - 0.5 * state.dt;
  });
}

/// Whether the step before says nothing about the next.
bool begins_anew(const State& state) {
  return state.step == 0 || !state.events.empty() || is_at_jump(state);
}

/// The time in which the imposed flow moves a vertex by its shortest edge.
double imposed_edge_time(const Scene& scene, double t) {
  double rate = 0.0;
  for (const Interface& interface : scene.interfaces) {
    const VertexField<double> edge = shortest_edges(interface.mesh);
    for (const VertexId v : edge.ids())
      rate = std::max(rate, scene.flow.velocity(interface.mesh.x[v], t).norm() / edge[v]);
  }
  return 1.0 / rate;
}

void begin_anew(StepPlan& plan, const State& state) {
  shorten(plan, kFirstShare * longest_stable_step(state.scene, TimeScheme::rk2),
          StepBound::beginning);
  shorten(plan, kFirstShare * kAimedDisplacement * imposed_edge_time(state.scene, state.t),
          StepBound::beginning);
}

/// Bounds that follow from the step before, which was of length dt.
void follow_record(StepPlan& plan, const StepRecord& record, double dt, double tolerance) {
  shorten(plan, (record.bound == StepBound::refusal ? 1.0 : kMostGrowth) * dt, StepBound::growth);
  if (record.error)
    shorten(plan, dt * std::sqrt(kAimedShare * tolerance / *record.error), StepBound::error);
  shorten(plan, dt / record.travel.slip, StepBound::slip);
  shorten(plan, dt * kAimedDisplacement / record.travel.displacement, StepBound::displacement);
  shorten(plan, dt * kAimedNeckLoss / record.travel.neck_loss, StepBound::neck);
  if (record.courant > 0.0)
    shorten(plan, dt * kAimedCourant / record.courant, StepBound::convection);
}

/// Lets a step that would pass `time` end there, or halfway.
void end_at(StepPlan& plan, const State& state, double time) {
  const double rest = time - state.t;
  if (rest <= 0.0 || 2.0 * plan.dt <= rest) return;
  if (plan.dt < rest) {
    shorten(plan, 0.5 * rest, StepBound::jump);
    return;
  }
  plan = {rest, StepBound::jump};
  while (state.t + plan.dt < time) plan.dt = std::nextafter(plan.dt, kInfinity);
}

/// The estimate of a step compares the flow at its ends and within. It would not see a jump, or the
/// beginning of a ramp, between its stages.
void end_where_flow_breaks(StepPlan& plan, const State& state) {
  for (const ImposedFlow::Entry& entry : state.scene.flow.schedule()) {
    end_at(plan, state, entry.time);
    if (entry.ramp > 0.0) end_at(plan, state, entry.time + entry.ramp);
  }
}

std::optional<Fault> find_excess(double value, double aimed, const char* what) {
  if (value <= kMostExcess * aimed) return {};
  return Fault{FaultKind::inaccurate,
               fmt::format("{} is {:.2g}, where {:.2g} is aimed at", what, value, aimed)};
}

}  // namespace

StepPlan step_plan(const State& state, const EvolutionOptions& options) {
  if (options.control == StepControl::paper) return paper_plan(state, options);
  StepPlan plan{options.max_step, StepBound::max_step};
  shorten(plan, longest_stable_step(state.scene, options.scheme), StepBound::stability);
  if (begins_anew(state))
    begin_anew(plan, state);
  else
    follow_record(plan, state.record, state.dt, options.tolerance);
  end_where_flow_breaks(plan, state);
  if (plan.dt < options.min_step) plan = {options.min_step, StepBound::min_step};
  return plan;
}

std::optional<Fault> find_excess(const StepRecord& attempt, const EvolutionOptions& options) {
  if (attempt.error && !(*attempt.error <= options.tolerance))
    return Fault{FaultKind::inaccurate,
                 fmt::format("its error is estimated at {:.2g} edges, above {:g}", *attempt.error,
                             options.tolerance)};
  if (options.control == StepControl::paper) return {};
  const VertexTravel& travel = attempt.travel;
  if (auto fault =
          find_excess(travel.displacement, kAimedDisplacement, "its displacement in edges"))
    return fault;
  if (auto fault = find_excess(travel.slip, 1.0, "its slip over the mesh, in stable ones,"))
    return fault;
  if (auto fault = find_excess(travel.neck_loss, kAimedNeckLoss, "the loss of a neck in radii"))
    return fault;
  return find_excess(attempt.courant, kAimedCourant, "the liquid's way past the mesh in edges");
}

StepPlan shorter_plan(const StepPlan& refused, const StepRecord& attempt,
                      const EvolutionOptions& options) {
  double factor = 0.5;
  if (options.control == StepControl::error && attempt.error > options.tolerance)
    factor = std::clamp(std::sqrt(kAimedShare * options.tolerance / *attempt.error),
                        kMostShortening, kLeastShortening);
  return {factor * refused.dt, StepBound::refusal};
}

}  // namespace meniscus
