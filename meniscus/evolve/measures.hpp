#pragma once

#include <vector>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/record.hpp"
#include "meniscus/evolve/state.hpp"

namespace meniscus {

/// The row of history.csv of a state whose flow was solved. `motion` is the velocity of the
/// interfaces' vertices; `surface` says whether faces are flat or curved.
[[nodiscard]] HistoryRow history_row(const State& state, const FlowSolution& flow,
                                     const InterfaceMotion& motion, SurfaceShape surface);

/// The rows of drops.csv, one per interface. Necks are searched if `breakup_radius` is positive.
[[nodiscard]] std::vector<DropRow> drop_rows(const State& state, SurfaceShape surface,
                                             double breakup_radius);

}  // namespace meniscus
