#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

/// Which global nodes the local nodes of each cell are: |C| × nodes_per_cell.
struct NodeTable {
  std::int32_t num_nodes = 0;
  std::int32_t nodes_per_cell = 0;
  std::vector<std::int32_t> cell_nodes;

  [[nodiscard]] std::int32_t num_cells() const {
    return static_cast<std::int32_t>(cell_nodes.size()) / nodes_per_cell;
  }
  [[nodiscard]] std::span<const std::int32_t> of(CellId c) const {
    return std::span(cell_nodes)
        .subspan(static_cast<std::size_t>(c.value * nodes_per_cell),
                 static_cast<std::size_t>(nodes_per_cell));
  }
};

/// Continuous P1 velocity: one node per vertex.
[[nodiscard]] NodeTable velocity_nodes(const TetMesh& mesh);

/// P1 pressure, continuous in each region and double valued on interfaces (eqs 36–40 of
/// hooper2001): one node per pair of a vertex and a region that has a cell there, in the order of
/// vertices, then regions.
struct PressureSpace {
  NodeTable nodes;
  std::vector<TetVertexId> vertex;  ///< of each node
  std::vector<RegionId> region;     ///< of each node
};
[[nodiscard]] PressureSpace pressure_space(const TetMesh& mesh);

}  // namespace meniscus::fem
