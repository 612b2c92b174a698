#pragma once

#include <vector>

#include "meniscus/core/field.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// For each region after a change of topology the regions before it whose liquid it took. The
/// children of a cut name one parent, the child of a merger names two. A drop released from another
/// is a source of the liquid around. Empty: every region is what it was.
using RegionSources = Field<RegionId, std::vector<RegionId>>;

/// The sources across two changes, one after the other.
[[nodiscard]] RegionSources joined_sources(const RegionSources& first, const RegionSources& second);

}  // namespace meniscus
