#include "meniscus/evolve/time_schemes.hpp"

namespace meniscus {

StageFlow euler_step(const StageFlow& first) { return first; }

StageFlow midpoint_step(const StageFlow& first, double t, double dt, const StageSolver& solve) {
  return solve(first, 0.5 * dt, {.t = t + 0.5 * dt, .dt = dt, .stage = Stage::middle});
}

}  // namespace meniscus
