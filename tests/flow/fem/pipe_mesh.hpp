#pragma once

#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

/// A piece of a pipe of radius 1 along x, of length 1: cross-sections of `rings` rings with 6k
/// points on ring k, in `rings` layers of prisms, each cut in three tetrahedra. One region.
[[nodiscard]] TetMesh pipe_mesh(int rings);
[[nodiscard]] inline double distance_from_axis(const Vec3& x) { return std::hypot(x.y(), x.z()); }
/// Moves the middles of the wall's edges to the round wall.
void bend_pipe_wall(const TetMesh& mesh, const FlowSpace& space, NodePositions& positions);

}  // namespace meniscus::fem
