#include "meniscus/volume/cells_around.hpp"

#include <numeric>

namespace meniscus {

CellsAround::CellsAround(std::int32_t num_vertices, const CellField<CellVertices>& cells)
    : first_(num_vertices + 1, 0), cell_(4 * static_cast<std::size_t>(cells.size())) {
  for (const CellVertices& vertices : cells)
    for (const TetVertexId v : vertices) ++first_[TetVertexId{v.value + 1}];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  Field<TetVertexId, std::size_t> next = first_;
  for (const CellId c : cells.ids())
    for (const TetVertexId v : cells[c]) cell_[next[v]++] = c;
}

}  // namespace meniscus
