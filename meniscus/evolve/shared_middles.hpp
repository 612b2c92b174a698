#pragma once

#include <vector>

#include "meniscus/surface/edge_middles.hpp"

namespace meniscus {

/// `middles_on_splines`, of which each of the processes finds a share. Collective.
[[nodiscard]] std::vector<Vec3> shared_middles_on_splines(const SurfaceMesh& mesh,
                                                          const SurfaceTopology& topology,
                                                          const SmoothSurface& smooth);

}  // namespace meniscus
