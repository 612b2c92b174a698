#include "meniscus/volume/mesh_order.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The cells around each vertex, one list after the other.
struct CellsAround {
  std::vector<std::int32_t> first, cell;

  CellsAround(std::int32_t num_vertices, const CellField<CellVertices>& cells)
      : first(at(num_vertices) + 1, 0), cell(4 * at(cells.size())) {
    for (const CellVertices& vertices : cells)
      for (const TetVertexId v : vertices) ++first[at(v.value) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::int32_t> next(first.begin(), first.end() - 1);
    for (const CellId c : cells.ids())
      for (const TetVertexId v : cells[c]) cell[at(next[at(v.value)]++)] = c.value;
  }
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t v) const {
    return std::span(cell).subspan(at(first[at(v)]), at(first[at(v) + 1] - first[at(v)]));
  }
};

/// When each vertex and each cell is met.
struct Meeting {
  std::vector<std::int32_t> vertices, cells;  ///< in that order

  Meeting(std::int32_t num_vertices, const CellField<CellVertices>& all) {
    const CellsAround around(num_vertices, all);
    std::vector<char> has_vertex(at(num_vertices), 0), has_cell(at(all.size()), 0);
    const auto meet = [&](std::int32_t v) {
      if (!std::exchange(has_vertex[at(v)], 1)) vertices.push_back(v);
    };
    for (std::int32_t start = 0; start < num_vertices; ++start) {
      meet(start);
      for (std::size_t k = vertices.size() - 1; k < vertices.size(); ++k)
        for (const std::int32_t c : around.of(vertices[k])) {
          if (std::exchange(has_cell[at(c)], 1)) continue;
          cells.push_back(c);
          for (const TetVertexId v : all[CellId{c}]) meet(v.value);
        }
    }
  }
};

}  // namespace

void order_by_neighbourhood(std::int32_t num_fixed, Field<TetVertexId, Vec3>& x,
                            CellField<CellVertices>& cells) {
  const Meeting met(x.size(), cells);
  Field<TetVertexId, TetVertexId> number(x.size());
  Field<TetVertexId, Vec3> ordered_x(x.size());
  std::int32_t next = num_fixed;
  for (const std::int32_t v : met.vertices) {
    number[TetVertexId{v}] = TetVertexId{v < num_fixed ? v : next++};
    ordered_x[number[TetVertexId{v}]] = x[TetVertexId{v}];
  }
  CellField<CellVertices> ordered_cells;
  ordered_cells.reserve(cells.size());
  for (const std::int32_t c : met.cells) {
    CellVertices vertices = cells[CellId{c}];
    for (TetVertexId& v : vertices) v = number[v];
    ordered_cells.add(vertices);
  }
  x = std::move(ordered_x);
  cells = std::move(ordered_cells);
}

}  // namespace meniscus
