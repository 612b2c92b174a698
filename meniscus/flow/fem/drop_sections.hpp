#pragma once

#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

using VertexWeights = Field<TetVertexId, double>;

/// Overlapping sections of a region along its length, as weights of the mesh's vertices between 0
/// and 1 that sum to 1 in the region. Outside they fade to 0 over R, the radius of the sphere of
/// the region's volume. Sections are added until each vertex is within 1.5 R of one's centre, along
/// edges of the region, but no more than `most` > 0. A sphere has one. Cost: n log n for each.
[[nodiscard]] std::vector<VertexWeights> sections(const TetMesh& mesh, RegionId region, int most);

}  // namespace meniscus::fem
