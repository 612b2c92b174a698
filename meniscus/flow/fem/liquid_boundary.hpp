#pragma once

#include <array>
#include <vector>

#include "meniscus/flow/fem/node_graph.hpp"

namespace meniscus::fem {

/// A face of one cell where its liquid ends.
struct LiquidFace {
  CellId cell;
  std::array<std::size_t, 3> corners;  ///< of the cell, counter-clockwise seen from outside
};

/// All of them, in the order of their cells, and of a rank's share also those where it ends: the
/// faces that one cell alone has, by their nodes of the pressure, which no two liquids have in
/// common.
[[nodiscard]] std::vector<LiquidFace> liquid_faces(const NodeTable& pressures,
                                                   const NodeGraph& pressure_graph);

}  // namespace meniscus::fem
