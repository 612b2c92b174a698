#pragma once

#include <optional>

#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/vertex_travel.hpp"

namespace meniscus {

struct State;

/// What decided the length of a step.
enum class StepBound {
  step_factor,   ///< the paper's rule
  error,         ///< the estimate of the error
  stability,     ///< an explicit scheme's, of the shortest capillary waves
  slip,          ///< the shape slides over the mesh
  displacement,  ///< of vertices, which the meshes must bear
  neck,          ///< a neck keeps most of its radius
  growth,        ///< over the step before
  beginning,     ///< no step to go by: at the start, after an event or a jump of the flow
  jump,          ///< the step ends where the imposed flow jumps, or at an end of a ramp
  max_step,      ///< time.max-step
  min_step,      ///< time.min-step
  refusal,       ///< a longer attempt was refused
  convection     ///< liquids with inertia cross the mesh
};

/// The length of a step, and what decided it.
struct StepPlan {
  double dt = 0.0;
  StepBound bound = StepBound::max_step;
};

/// What is known of a step once its motion is found. The next step's length follows from it.
struct StepRecord {
  StepBound bound = StepBound::beginning;
  std::optional<double> error;  ///< `StageFlow::error`; none of a scheme without estimate
  VertexTravel travel;
  /// Largest way of liquid with inertia past the mesh, in shortest edges at the vertex.
  double courant = 0.0;
  bool is_excessive = false;  ///< refused by error control (`find_excess`)
  bool is_mesh_kept = false;  ///< interfaces and mesh keep their connectivity
};

/// The length with which the step from a state is tried first. It depends on the state alone.
///
/// With StepControl::paper (eq. 27 of hooper2001): Δt = step_factor · min(1, 1/tension) · l_min, at
/// most `max_step` and the longest stable step of the scheme. Tension is the largest of all
/// interfaces, l_min the shortest edge that the options look at.
///
/// With StepControl::error the shortest of several. One makes the error, ~ Δt², the aimed share
/// of the tolerance, others each travel what is aimed at. The rest are the scheme's longest
/// stable step, a multiple of the last and `max_step`. Where there is no step to go by, a
/// fraction of the midpoint rule's longest stable step. In it the imposed flow moves no vertex
/// farther than a fraction of its edge. A step ends where the imposed flow jumps, and at the ends
/// of a ramp.
[[nodiscard]] StepPlan step_plan(const State& state, const EvolutionOptions& options);

/// A fault where the estimated error of an attempt exceeds the tolerance or, with
/// StepControl::error, vertices travel too far.
[[nodiscard]] std::optional<Fault> find_excess(const StepRecord& attempt,
                                               const EvolutionOptions& options);

/// The plan after an attempt was refused: half its length, or as its error says.
[[nodiscard]] StepPlan shorter_plan(const StepPlan& refused, const StepRecord& attempt,
                                    const EvolutionOptions& options);

}  // namespace meniscus
