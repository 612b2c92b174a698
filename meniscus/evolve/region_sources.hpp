#pragma once

#include <vector>

#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/events.hpp"
#include "meniscus/volume/field_transfer.hpp"

namespace meniscus {

/// Which regions of a scene before events each region of the scene after them has its liquid from:
/// by the drops' ids, the children of a cut from its parent, the child of a merger from both. Empty
/// where nothing happened. Regions that are gone without a child (a drop within a drop that opened
/// into the liquid around) are among the sources of the matrix.
[[nodiscard]] RegionSources region_sources(const Scene& before, const Scene& after,
                                           const std::vector<TopologyEvent>& events);

}  // namespace meniscus
