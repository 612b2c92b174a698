#pragma once

#include "meniscus/volume/mesh_overlay.hpp"

namespace meniscus {

/// Where the vertices of the new mesh lie among the old cells of the groups that they touch.
[[nodiscard]] Field<TetVertexId, CellTree::Hit> locate_vertices(const MeshOverlay& overlay);

/// A field on the old vertices, at these points. The values are Σ w_k (u_k + ½ ∇u_k · (x − x_k)),
/// kept between the least and the greatest u_k. w_k are the weights of linear interpolation and
/// ∇u_k the mean gradients of the group's cells at each corner. Linear.
[[nodiscard]] Field<TetVertexId, double> interpolated_at_vertices(
    const MeshOverlay& overlay, const Field<TetVertexId, CellTree::Hit>& hits,
    const Field<TetVertexId, double>& values);

}  // namespace meniscus
