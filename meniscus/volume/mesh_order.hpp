#pragma once

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// Puts neighbours close to each other in memory. Vertices from `num_fixed` on, and all cells, go
/// in the order in which a breadth-first search along edges meets them. Assembly and products with
/// the matrices then read what is in the cache; a mesher leaves both in the order in which it
/// inserted them.
void order_by_neighbourhood(std::int32_t num_fixed, Field<TetVertexId, Vec3>& x,
                            CellField<CellVertices>& cells);

}  // namespace meniscus
