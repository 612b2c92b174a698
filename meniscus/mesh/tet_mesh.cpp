#include "meniscus/mesh/tet_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace meniscus {

double signed_volume(const TetMesh& mesh, CellId c) {
  const CellVertices& v = mesh.cells[c];
  const Vec3& o = mesh.x[v[0]];
  return (mesh.x[v[1]] - o).cross(mesh.x[v[2]] - o).dot(mesh.x[v[3]] - o) / 6.0;
}

double shortest_edge(const TetMesh& mesh) {
  double squared = std::numeric_limits<double>::infinity();
  for (const CellVertices& v : mesh.cells)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        squared = std::min(squared, (mesh.x[v[i]] - mesh.x[v[j]]).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace meniscus
