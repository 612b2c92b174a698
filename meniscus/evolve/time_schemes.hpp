#pragma once

#include <functional>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus {

/// The flow at one stage of a step, and the velocity with which it moves the interfaces' vertices.
struct StageFlow : Report {
  FlowSolution flow = {};
  InterfaceMotion motion = {};
};

/// Moves the interfaces `duration` from where the step began, with the motion of a stage and the
/// mesh with them, and solves the flow there.
using StageSolver =
    std::function<StageFlow(const StageFlow& stage, double duration, const Instant& instant)>;

/// One step of length dt from t: the stage whose motion takes the interfaces from the step's
/// beginning to its end. `first` is the flow at t.
[[nodiscard]] StageFlow euler_step(const StageFlow& first);
/// The midpoint rule (first lines of Table 1 of hooper2001).
[[nodiscard]] StageFlow midpoint_step(const StageFlow& first, double t, double dt,
                                      const StageSolver& solve);

}  // namespace meniscus
