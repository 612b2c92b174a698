#pragma once

#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// Saves the events of the step that led to a checkpoint. Their rows are written with the rows of
/// its step.
void save_events(const std::vector<TopologyEvent>& events, Archive& archive);
[[nodiscard]] std::vector<TopologyEvent> load_events(const Archive& archive);

}  // namespace meniscus
