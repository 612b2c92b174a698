#pragma once

#include "meniscus/scene/region_sources.hpp"
#include "meniscus/transport/bulk/scalar_space.hpp"

namespace meniscus::bulk {

/// A mesh with its space and where its nodes are.
struct PlacedSpace {
  const TetMesh& mesh;
  const ScalarSpace& space;
  const NodePositions& positions;
};

/// Nodal values on another mesh of the same liquids: of the elements' own order at each new node.
/// `sources` says which liquid each region
/// took.
[[nodiscard]] std::vector<double> interpolated_values(std::span<const double> values,
                                                      const PlacedSpace& from,
                                                      const PlacedSpace& to,
                                                      const RegionSources& sources);

}  // namespace meniscus::bulk
