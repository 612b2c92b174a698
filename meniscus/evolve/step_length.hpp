#pragma once

#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/state.hpp"

namespace meniscus {

/// Δt = step_factor · min(1, 1/tension) · l_min, at most `max_step` (eq. 27 of hooper2001): tension
/// is the largest of all interfaces, l_min the shortest edge that the options look at.
[[nodiscard]] double step_length(const State& state, const EvolutionOptions& options);

}  // namespace meniscus
