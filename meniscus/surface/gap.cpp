#include "meniscus/surface/gap.hpp"

#include <algorithm>
#include <limits>

namespace meniscus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Start of a ray off its own vertex, over its reach: above round-off, below any gap of note.
constexpr double kOffset = 1e-7;

double width_along(const SurfaceTree& tree, const Vec3& x, const Vec3& direction, double reach) {
  const auto hit = tree.first_hit(x + kOffset * reach * direction, direction, reach);
  return hit ? hit->distance : kInfinity;
}

}  // namespace

OwnGaps own_gaps(const SurfaceMesh& mesh, const SurfaceTree& tree, const VertexField<Vec3>& normals,
                 const VertexField<double>& reach) {
  OwnGaps gaps{VertexField<double>(mesh.num_vertices()), VertexField<double>(mesh.num_vertices())};
  for (const VertexId v : mesh.x.ids()) {
    gaps.inside[v] = width_along(tree, mesh.x[v], -normals[v], reach[v]);
    gaps.outside[v] = width_along(tree, mesh.x[v], normals[v], reach[v]);
  }
  return gaps;
}

void bound_by_gaps(VertexField<double>& length, const SurfaceMesh& mesh,
                   const VertexField<Vec3>& normals, double layers,
                   std::span<const SurfaceTree* const> neighbours) {
  const double edges_per_width = kGapEdge / layers;
  VertexField<double> reach = length;  // beyond, a gap asks for no shorter an edge
  for (double& r : reach) r /= edges_per_width;
  const OwnGaps own = own_gaps(mesh, SurfaceTree(mesh), normals, reach);
  for (const VertexId v : mesh.x.ids()) {
    double width = std::min({own.inside[v], own.outside[v], reach[v]});
    for (const SurfaceTree* neighbour : neighbours)
      width = std::min(width, neighbour->closest(mesh.x[v], width).distance);
    length[v] = std::min(length[v], edges_per_width * width);
  }
}

}  // namespace meniscus
