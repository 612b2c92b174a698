#pragma once

#include <vector>

#include "meniscus/flow/fem/spaces.hpp"
#include "meniscus/linear/communicator.hpp"

namespace meniscus::fem {

/// Groups of vertices that hang together: a vertex with all its neighbours where none of them had a
/// group before, the others with a neighbour. Numbered from zero, in the order of their vertices.
[[nodiscard]] std::vector<std::int32_t> vertex_groups(const FlowSpace& space);

/// The rank of each vertex, and by that of each cell, whose rank is that of its first vertex. Parts
/// have equal work and few cells between them. Cells go by the groups of their vertices, some
/// thirty vertices each. PT-Scotch divides so small a graph in no time. The same on all ranks; the
/// space must be, too. Throws InvalidInput where a rank would be left without a vertex. Collective.
[[nodiscard]] std::vector<std::int32_t> vertex_ranks(const FlowSpace& space,
                                                     linear::Communicator communicator);

}  // namespace meniscus::fem
