#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// The cells around each vertex of a mesh, rising. Linear to build.
class CellsAround {
 public:
  CellsAround(std::int32_t num_vertices, const CellField<CellVertices>& cells);
  [[nodiscard]] std::span<const CellId> of(TetVertexId v) const {
    const auto first = first_[v], end = first_[TetVertexId{v.value + 1}];
    return std::span(cell_).subspan(first, end - first);
  }

 private:
  Field<TetVertexId, std::size_t> first_;  // of each vertex's cells; one more at the end
  std::vector<CellId> cell_;
};

}  // namespace meniscus
