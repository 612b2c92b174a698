#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meniscus::linear {

/// An undirected graph in compressed rows. Each edge is in the rows of both its ends, with equal
/// weight.
struct WeightedGraph {
  std::vector<std::int32_t> row_start, neighbours, edge_weights;
  std::vector<std::int32_t> vertex_weights;
  [[nodiscard]] std::int32_t num_vertices() const {
    return static_cast<std::int32_t>(vertex_weights.size());
  }
};

enum class Partitioner {
  ptscotch,  ///< equal weights, few edges cut
  even       ///< consecutive parts with equal numbers of vertices; always available
};
/// PT-Scotch where PETSc has it, else `even`.
[[nodiscard]] Partitioner best_partitioner();

/// The part (0 to num_parts − 1) of each vertex of a graph. Computed on this process alone; equal
/// graphs give equal parts.
[[nodiscard]] std::vector<std::int32_t> partition(const WeightedGraph& graph, int num_parts,
                                                  Partitioner partitioner = best_partitioner());

}  // namespace meniscus::linear
