#include "meniscus/solids/tessellate.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

constexpr int kMostCuts = 8;  // of an edge: the error of the given faces falls to a 64th

int num_cuts(const SurfaceMesh& mesh, const SmoothSurface& surface, FaceId f, double error) {
  const FaceVertices& v = mesh.faces[f];
  double longest = 0.0, bend = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, (mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]]).norm());
    const VertexCurvature& c = surface.vertex_curvature()[v[k]];
    bend = std::max({bend, std::abs(c.k1), std::abs(c.k2)});
  }
  const double cuts = std::ceil(longest * std::sqrt(bend / (6.0 * error)));
  return static_cast<int>(std::clamp(cuts, 1.0, static_cast<double>(kMostCuts)));
}

}  // namespace

SurfaceMesh tessellation(const SurfaceMesh& mesh, const SmoothSurface& surface,
                         double chordal_error) {
  MENISCUS_ASSERT(surface.vertex_curvature().size() == mesh.num_vertices(),
                  "the smooth surface of another mesh");
  SurfaceMesh result;
  for (const FaceId f : mesh.faces.ids()) {
    const int n = num_cuts(mesh, surface, f, chordal_error);
    // Row i of the lattice has i + 1 points, the first row the corner 0.
    const std::int32_t first = result.num_vertices();
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= i; ++j)
        result.x.add(surface.point(f, Vec3(n - i, i - j, j) / static_cast<double>(n)));
    const auto id = [first](int i, int j) { return VertexId{first + i * (i + 1) / 2 + j}; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        result.faces.add({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        if (j < i) result.faces.add({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      }
  }
  return result;
}

}  // namespace meniscus
