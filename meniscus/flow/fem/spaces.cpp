#include "meniscus/flow/fem/spaces.hpp"

#include <algorithm>
#include <utility>

namespace meniscus::fem {
namespace {

/// The regions around each vertex in rising order, as one list with offsets.
struct RegionsAtVertices {
  std::vector<std::int32_t> first;  ///< of vertex v: [first[v], first[v + 1])
  std::vector<RegionId> region;
};

RegionsAtVertices regions_at_vertices(const TetMesh& mesh) {
  // Nearly every vertex has one region: keep that one apart, and the others in a short list.
  Field<TetVertexId, RegionId> only(mesh.num_vertices());
  std::vector<std::pair<TetVertexId, RegionId>> pairs;
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c]) {
      if (!only[v].is_valid()) only[v] = mesh.region[c];
      if (only[v] != mesh.region[c]) pairs.emplace_back(v, mesh.region[c]);
    }
  for (const TetVertexId v : mesh.x.ids())
    if (only[v].is_valid()) pairs.emplace_back(v, only[v]);
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());

  RegionsAtVertices result;
  result.first.assign(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0);
  for (const auto& [v, region] : pairs) {
    ++result.first[static_cast<std::size_t>(v.value) + 1];
    result.region.push_back(region);
  }
  for (std::size_t v = 1; v < result.first.size(); ++v) result.first[v] += result.first[v - 1];
  return result;
}

}  // namespace

NodeTable velocity_nodes(const TetMesh& mesh) {
  NodeTable table{mesh.num_vertices(), 4, {}};
  table.cell_nodes.reserve(static_cast<std::size_t>(mesh.num_cells()) * 4);
  for (const CellVertices& cell : mesh.cells)
    for (const TetVertexId v : cell) table.cell_nodes.push_back(v.value);
  return table;
}

PressureSpace pressure_space(const TetMesh& mesh) {
  const RegionsAtVertices around = regions_at_vertices(mesh);
  PressureSpace space;
  space.region = around.region;
  space.vertex.reserve(around.region.size());
  for (const TetVertexId v : mesh.x.ids())
    for (auto k = around.first[static_cast<std::size_t>(v.value)];
         k < around.first[static_cast<std::size_t>(v.value) + 1]; ++k)
      space.vertex.push_back(v);
  space.nodes = {static_cast<std::int32_t>(space.region.size()), 4, {}};
  space.nodes.cell_nodes.reserve(static_cast<std::size_t>(mesh.num_cells()) * 4);
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c]) {
      std::int32_t node = around.first[static_cast<std::size_t>(v.value)];
      while (space.region[static_cast<std::size_t>(node)] != mesh.region[c]) ++node;
      space.nodes.cell_nodes.push_back(node);
    }
  return space;
}

}  // namespace meniscus::fem
