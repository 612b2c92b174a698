#include "meniscus/volume/mesh_order.hpp"

#include <utility>
#include <vector>

#include "meniscus/volume/cells_around.hpp"

namespace meniscus {
namespace {

/// When each vertex and each cell is met.
struct Meeting {
  std::vector<TetVertexId> vertices;  ///< in that order
  std::vector<CellId> cells;

  Meeting(std::int32_t num_vertices, const CellField<CellVertices>& all) {
    const CellsAround around(num_vertices, all);
    Field<TetVertexId, char> has_vertex(num_vertices, 0);
    CellField<char> has_cell(all.size(), 0);
    const auto meet = [&](TetVertexId v) {
      if (!std::exchange(has_vertex[v], 1)) vertices.push_back(v);
    };
    for (const TetVertexId start : has_vertex.ids()) {
      meet(start);
      for (std::size_t k = vertices.size() - 1; k < vertices.size(); ++k)
        for (const CellId c : around.of(vertices[k])) {
          if (std::exchange(has_cell[c], 1)) continue;
          cells.push_back(c);
          for (const TetVertexId v : all[c]) meet(v);
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
  for (const TetVertexId v : met.vertices) {
    number[v] = v.value < num_fixed ? v : TetVertexId{next++};
    ordered_x[number[v]] = x[v];
  }
  CellField<CellVertices> ordered_cells;
  ordered_cells.reserve(cells.size());
  for (const CellId c : met.cells) {
    CellVertices vertices = cells[c];
    for (TetVertexId& v : vertices) v = number[v];
    ordered_cells.add(vertices);
  }
  x = std::move(ordered_x);
  cells = std::move(ordered_cells);
}

}  // namespace meniscus
