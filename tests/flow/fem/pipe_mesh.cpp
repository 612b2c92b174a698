#include "tests/flow/fem/pipe_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus::fem {
namespace {

struct Disc {
  std::vector<Vec3> points;  ///< in the plane x = 0
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Number of point j of ring k, counted around it.
std::int32_t point(std::int32_t k, std::int32_t j) {
  return k == 0 ? 0 : 1 + 3 * k * (k - 1) + j % (6 * k);
}

Disc disc(std::int32_t rings) {
  Disc result{{Vec3::Zero()}, {}};
  for (std::int32_t k = 1; k <= rings; ++k) {
    for (std::int32_t j = 0; j < 6 * k; ++j) {
      const double angle = std::numbers::pi * j / (3.0 * k), radius = double(k) / rings;
      result.points.emplace_back(0.0, radius * std::cos(angle), radius * std::sin(angle));
    }
    for (std::int32_t sector = 0; sector < 6; ++sector)
      for (std::int32_t j = 0; j < k; ++j) {
        const std::int32_t outer = sector * k + j, inner = sector * (k - 1) + j;
        result.triangles.push_back({point(k, outer), point(k, outer + 1), point(k - 1, inner)});
        if (j + 1 < k)
          result.triangles.push_back(
              {point(k, outer + 1), point(k - 1, inner + 1), point(k - 1, inner)});
      }
  }
  return result;
}

}  // namespace

TetMesh pipe_mesh(int rings) {
  const Disc section = disc(rings);
  const auto size = static_cast<std::int32_t>(section.points.size());
  TetMesh mesh;
  for (int layer = 0; layer <= rings; ++layer)
    for (const Vec3& x : section.points)
      mesh.x.add(x + Vec3(double(layer) / rings - 0.5, 0.0, 0.0));
  for (int layer = 0; layer < rings; ++layer)
    for (std::array<std::int32_t, 3> column : section.triangles) {
      std::ranges::sort(column);  // so that neighbours cut their common side alike
      // One tetrahedron for each column in which the path from bottom to top may rise.
      for (std::size_t rise = 0; rise < 3; ++rise) {
        CellVertices cell;
        for (std::size_t k = 0; k < 4; ++k) {
          const bool is_above = k > rise;
          cell[k] =
              TetVertexId{column[k - (is_above ? 1 : 0)] + size * (layer + (is_above ? 1 : 0))};
        }
        mesh.cells.add(cell);
        mesh.region.add(RegionId{0});
        const CellId c{mesh.num_cells() - 1};
        if (signed_volume(mesh, c) < 0.0) std::swap(mesh.cells[c][2], mesh.cells[c][3]);
      }
    }
  return mesh;
}

void bend_pipe_wall(const TetMesh& mesh, const FlowSpace& space, NodePositions& positions) {
  const auto is_on_wall = [&](TetVertexId v) {
    return std::abs(distance_from_axis(mesh.x[v]) - 1.0) < 1e-12;
  };
  for (std::size_t e = 0; e < space.edges.size(); ++e) {
    if (!is_on_wall(space.edges[e][0]) || !is_on_wall(space.edges[e][1])) continue;
    Vec3& x = positions.x[NodeId{space.num_vertices() + static_cast<std::int32_t>(e)}];
    const double radius = distance_from_axis(x);
    x = Vec3(x.x(), x.y() / radius, x.z() / radius);
  }
  settle_curved_cells(mesh, space, {}, positions);
}

}  // namespace meniscus::fem
