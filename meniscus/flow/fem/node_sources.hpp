#pragma once

#include <vector>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/scene/region_sources.hpp"

namespace meniscus::fem {

/// A mesh with its space and where its nodes are.
struct PlacedSpace {
  const TetMesh& mesh;
  const FlowSpace& space;
  const NodePositions& positions;
};

/// Where a node of one mesh lies in another: in a cell, or nearest to it.
struct NodeSource {
  CellId cell;
  std::array<double, 4> barycentric{};  ///< of the curved cell
  double squared_distance = 0.0;        ///< to it where the node lies beyond all cells [R0²]
};

/// The places of all nodes of `to` in `from`, each in a liquid that its region took (`sources`). A
/// node on an interface is looked for on both sides: the nearer one counts.
[[nodiscard]] std::vector<NodeSource> node_sources(const PlacedSpace& from, const PlacedSpace& to,
                                                   const RegionSources& sources);

/// φ_i of a space's elements at a place, and the nodes that they belong to.
[[nodiscard]] std::array<double, 10> shape_values(const FlowSpace& space,
                                                  const std::array<double, 4>& barycentric);

/// A nodal field at the places of other nodes: of the elements' order.
template <class Value>
[[nodiscard]] std::vector<Value> interpolated_values(std::span<const Value> values,
                                                     const FlowSpace& space,
                                                     std::span<const NodeSource> at) {
  std::vector<Value> result;
  result.reserve(at.size());
  for (const NodeSource& source : at) {
    const auto nodes = space.velocity.of(source.cell);
    const std::array<double, 10> shape = shape_values(space, source.barycentric);
    Value sum = shape[0] * values[static_cast<std::size_t>(nodes[0])];
    for (std::size_t i = 1; i < nodes.size(); ++i)
      sum += shape[i] * values[static_cast<std::size_t>(nodes[i])];
    result.push_back(sum);
  }
  return result;
}

}  // namespace meniscus::fem
