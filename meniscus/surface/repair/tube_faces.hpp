#pragma once

#include <span>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The faces of a tube between two closed curves of vertices of a surface. Each is given with the
/// disc that was taken out on its left. Ways to join them begin with the shortest line between them
/// and twist them by less than half a turn. Of these it is the one whose lines across have the
/// least sum of squares. O(m n).
[[nodiscard]] std::vector<FaceVertices> tube_faces(const SurfaceMesh& mesh,
                                                   std::span<const VertexId> a,
                                                   std::span<const VertexId> b);

}  // namespace meniscus
