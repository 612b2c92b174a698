#pragma once

#include "meniscus/evolve/state.hpp"

namespace meniscus {

/// The state at the start of a step, to which undoing an attempt returns.
class StepStart {
 public:
  /// Copies the state without its mesh, which keeps its own start positions.
  explicit StepStart(State& state);

  [[nodiscard]] const Scene& scene() const { return state_.scene; }
  /// Restores the state. The count of iterations is kept.
  void restore(State& state) const;

 private:
  State state_;  // copy of the state without its mesh
};

}  // namespace meniscus
