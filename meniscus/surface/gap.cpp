#include "meniscus/surface/gap.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/box_tree.hpp"

namespace meniscus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Edges are not asked to be shorter than half of those opposite, whatever the gap. Beside a wall
/// of far longer edges they make slivers (smallest dihedral angle 0.6° where it was 7.6°) and no
/// layers. Two interfaces that both follow the rule come down by turns.
constexpr double kFinerThanOpposite = 0.5;
/// Start of a ray off its own vertex, over its reach: above round-off, below any gap of note.
constexpr double kOffset = 1e-7;
constexpr double kRoundOff = 1.0 + 1e-12;  // of a bound that leaves surfaces out

/// Mean edge of the face that was hit.
double edge_at(const SurfaceTree& tree, const SurfaceTree::Hit& hit) {
  double edge = 0.0;
  // The point is on the face but for round-off, which a box without thickness would not forgive.
  const Vec3 margin = Vec3::Constant(1e-9 * (tree.high() - tree.low()).norm());
  tree.visit_box(hit.point - margin, hit.point + margin, [&](FaceId f, const Triangle& x) {
    if (f == hit.face)
      edge = ((x[1] - x[0]).norm() + (x[2] - x[1]).norm() + (x[0] - x[2]).norm()) / 3.0;
    return f != hit.face;
  });
  return edge;
}

double width_along(const SurfaceTree& tree, const Vec3& x, const Vec3& direction, double reach) {
  const auto hit = tree.first_hit(x + kOffset * reach * direction, direction, reach);
  return hit ? hit->distance : kInfinity;
}

/// The neighbours whose boxes are within `reach` of a mesh's box.
std::vector<const SurfaceTree*> within_reach(const SurfaceMesh& mesh, double reach,
                                             std::span<const SurfaceTree* const> neighbours) {
  const Box box = bounding_box(mesh);
  std::vector<const SurfaceTree*> near;
  for (const SurfaceTree* neighbour : neighbours)
    if (box.exteriorDistance(Box(neighbour->low(), neighbour->high())) <= kRoundOff * reach)
      near.push_back(neighbour);
  return near;
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
  MENISCUS_ASSERT(layers > 0.0, "layers = {}", layers);
  MENISCUS_ASSERT(length.size() == mesh.num_vertices() && normals.size() == mesh.num_vertices(),
                  "{} {} {}", length.size(), normals.size(), mesh.num_vertices());
  const double edges_per_width = kGapEdge / layers;
  VertexField<double> reach = length;  // beyond, a gap asks for no shorter an edge
  for (double& r : reach) r /= edges_per_width;
  const OwnGaps own = own_gaps(mesh, SurfaceTree(mesh), normals, reach);
  const std::vector<const SurfaceTree*> near =
      within_reach(mesh, std::ranges::max(reach), neighbours);
  for (const VertexId v : mesh.x.ids()) {
    length[v] = std::min(length[v], edges_per_width * std::min(own.inside[v], own.outside[v]));
    for (const SurfaceTree* neighbour : near) {
      const SurfaceTree::Hit hit = neighbour->closest(mesh.x[v], reach[v]);
      if (!hit.face.is_valid()) continue;
      const double opposite = kFinerThanOpposite * edge_at(*neighbour, hit);
      length[v] = std::min(length[v], std::max(edges_per_width * hit.distance, opposite));
    }
  }
}

}  // namespace meniscus
