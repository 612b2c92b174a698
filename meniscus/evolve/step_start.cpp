#include "meniscus/evolve/step_start.hpp"

#include <utility>

namespace meniscus {

StepStart::StepStart(State& state) {
  std::optional<MovingMesh> mesh = std::exchange(state.mesh, std::nullopt);
  state_ = state;
  state.mesh = std::move(mesh);
  if (state.mesh) state.mesh->begin_step(state.scene);
}

void StepStart::restore(State& state) const {
  std::optional<MovingMesh> mesh = std::move(state.mesh);
  const int iterations = state.iterations;
  state = state_;
  state.mesh = std::move(mesh);
  state.iterations = iterations;
  if (state.mesh) state.mesh->undo();
}

}  // namespace meniscus
