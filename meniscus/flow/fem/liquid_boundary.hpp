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

/// The faces on which liquids end, in the order of their cells. They are those that one cell alone
/// has, as no two liquids have a node of the pressure in common. On a partition the faces where it
/// ends are among them.
[[nodiscard]] std::vector<LiquidFace> liquid_faces(const NodeTable& pressures,
                                                   const NodeGraph& pressure_graph);

}  // namespace meniscus::fem
