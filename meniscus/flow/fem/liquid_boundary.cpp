#include "meniscus/flow/fem/liquid_boundary.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr std::array<std::array<std::size_t, 3>, 4> kCellFaces = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};  // opposite corner 0, 1, 2, 3

/// The faces opposite an inner node form a triangulated sphere, so that a node of n neighbours has
/// 2n − 4 cells (Euler). A node on a boundary has fewer.
std::vector<bool> nodes_on_boundary(const NodeTable& pressures, const NodeGraph& graph) {
  std::vector<std::int32_t> num_cells(at(graph.num_rows()), 0);
  for (const std::int32_t p : pressures.cell_nodes) ++num_cells[at(p)];
  std::vector<bool> result(num_cells.size());
  for (std::size_t p = 0; p < result.size(); ++p) {
    const std::int32_t num_neighbours = graph.row_start[p + 1] - graph.row_start[p] - 1;
    result[p] = num_cells[p] != 2 * num_neighbours - 4;
  }
  return result;
}

}  // namespace

std::vector<LiquidFace> liquid_faces(const NodeTable& pressures, const NodeGraph& pressure_graph) {
  struct Candidate {
    std::array<std::int32_t, 3> nodes;  // in rising order
    LiquidFace face;
  };
  const std::vector<bool> is_on_boundary = nodes_on_boundary(pressures, pressure_graph);
  std::vector<Candidate> candidates;
  for (const CellId c : ids<CellId>(pressures.num_cells()))
    for (const auto& corners : kCellFaces) {
      const auto nodes = pressures.of(c);
      std::array<std::int32_t, 3> key = {nodes[corners[0]], nodes[corners[1]], nodes[corners[2]]};
      if (!std::ranges::all_of(key, [&](std::int32_t p) { return is_on_boundary[at(p)]; }))
        continue;
      std::ranges::sort(key);
      candidates.push_back({key, {c, corners}});
    }
  std::ranges::sort(candidates, {}, &Candidate::nodes);
  std::vector<LiquidFace> faces;
  for (auto first = candidates.begin(); first != candidates.end();) {
    const auto next = std::find_if(first, candidates.end(),
                                   [&](const Candidate& c) { return c.nodes != first->nodes; });
    MENISCUS_ASSERT(next - first <= 2, "a face of {} cells", next - first);
    if (next - first == 1) faces.push_back(first->face);
    first = next;
  }
  return faces;
}

}  // namespace meniscus::fem
