#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meniscus::linear {

/// An undirected graph in compressed rows: each edge stands in the rows of both its ends, with the
/// same weight.
struct WeightedGraph {
  std::vector<std::int32_t> row_start, neighbours, edge_weights;
  std::vector<std::int32_t> vertex_weights;
  [[nodiscard]] std::int32_t num_vertices() const {
    return static_cast<std::int32_t>(vertex_weights.size());
  }
};

enum class Partitioner {
  ptscotch,  ///< equal weights, few edges cut
  even       ///< equal numbers of vertices, in their order: always there
};
/// PT-Scotch where PETSc has it.
[[nodiscard]] Partitioner best_partitioner();

/// The part, below `num_parts`, of each vertex of a graph. Done on this process alone, the same for
/// the same graph wherever and whenever.
[[nodiscard]] std::vector<std::int32_t> partition(const WeightedGraph& graph, int num_parts,
                                                  Partitioner partitioner = best_partitioner());

}  // namespace meniscus::linear
