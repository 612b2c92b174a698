#pragma once

#include "meniscus/evolve/constants.hpp"
#include "meniscus/linear/communicator.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/topology/apply_topology.hpp"

namespace meniscus {

enum class TimeScheme {
  rk2,            ///< midpoint rule (eq. 22 of hooper2001)
  euler,          ///< explicit (eq. 21)
  semi_implicit,  ///< the midpoint rule with damped stages: stable at long steps
  rkc,            ///< Runge–Kutta–Chebyshev of second order (sommeijer1998)
  implicit        ///< diagonally implicit, of second order: liquids with inertia
};
/// Normal with which an interface vertex moves, ẋ = n n·v (eq. 23). It is of the area vector A_i,
/// of the paraboloid fit (the paper's), or of the smooth surface. A_i keeps the faceted volume's
/// rate of change at round-off, but is O(h) on irregular meshes. The smooth normal is O(h³).
/// `faces` takes it, and lets curved faces follow the liquid in the mean (`follow_faces`).
enum class MotionNormal { area_vector, fit, smooth, faces };
enum class StepEdges { interface, mesh };  ///< where the step rule takes l_min from

/// How the length of a step is chosen: Δt = step_factor · min(1, Ca) · l_min (eq. 27 of
/// hooper2001). Or the estimate of the step's error and the bounds of `step_control.hpp` do.
enum class StepControl { paper, error };
/// The control of a case that does not name one.
inline constexpr StepControl kDefaultStepControl = StepControl::error;

struct EvolutionOptions {
  TimeScheme scheme = TimeScheme::rk2;
  MotionNormal motion_normal = MotionNormal::area_vector;
  SurfaceShape surface = SurfaceShape::faceted;
  double end = 1.0;  ///< the run stops at the first step with t ≥ end
  StepControl control = StepControl::paper;
  double tolerance = kMostError;  ///< largest estimate of a step's error (`StageFlow::error`)
  double step_factor = 0.5;       ///< Δt = step_factor · min(1, Ca) · l_min (eq. 27)
  StepEdges step_edges = StepEdges::interface;
  double max_step = 0.1;   ///< upper bound of Δt
  double min_step = 1e-6;  ///< a step that fails at this size ends the run
  /// The frame of reference moves with the drops. After every step they are shifted so that their
  /// centroid is where it was at the start. That is relative to the domain and the imposed flow.
  /// Experiments hold a drop at a stagnation point in this way (bentley1986).
  bool follows_drops = false;
  /// Steps between remeshings; 0: when an interface is no longer fit (`is_fit`).
  int remesh_every = 1;
  double spring_tolerance =
      0.0;                  ///< tolerance of the springs (RemeshOptions); 0: the remesher's default
  double edge_floor = 0.0;  ///< [R0] smallest target length of interface edges
  double neck_edges = 0.0;  ///< edges around a neck or a thread; 0: not controlled
  double gap_layers = 0.0;  ///< layers of tetrahedra between close sheets; 0: not controlled
  /// Which processes share the remeshing of the interfaces; all have the same state.
  linear::Processes processes = linear::Processes::alone;
  TopologyOptions topology;  ///< when necks are cut and gaps bridged
};

}  // namespace meniscus
