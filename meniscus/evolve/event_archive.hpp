#pragma once

#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// The events of the step before a checkpoint, whose rows are written with those of its step.
void save_events(const std::vector<TopologyEvent>& events, Archive& archive);
[[nodiscard]] std::vector<TopologyEvent> load_events(const Archive& archive);

}  // namespace meniscus
