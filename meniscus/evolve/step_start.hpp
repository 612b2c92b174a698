#pragma once

#include "meniscus/evolve/state.hpp"

namespace meniscus {

/// Where a step begins: what undoing it, or an attempt at it, goes back to.
class StepStart {
 public:
  /// Copies the state but for its mesh, which remembers for itself where it stands.
  explicit StepStart(State& state);

  [[nodiscard]] const Scene& scene() const { return state_.scene; }
  /// Puts the state back. The iterations spent since stay counted.
  void restore(State& state) const;

 private:
  State state_;  // without its mesh
};

}  // namespace meniscus
