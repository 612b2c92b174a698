#pragma once

#include <vector>

#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/flow/flow_solution.hpp"

namespace meniscus::fem {

/// What the liquid of each region has by a velocity that is given at the nodes of quadratic
/// elements. `gross`, where given, gets ∫ρ|v| dV of all, by the values at the nodes.
[[nodiscard]] std::vector<RegionMotion> region_motions(const Scene& scene, const TetMesh& mesh,
                                                       const FlowSpace& space,
                                                       const NodePositions& positions,
                                                       std::span<const Vec3> v,
                                                       double* gross = nullptr);

}  // namespace meniscus::fem
