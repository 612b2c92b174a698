#include "meniscus/volume/cell_walk.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/tetrahedron.hpp"
#include "meniscus/volume/cell_tree.hpp"

namespace meniscus {
namespace {

// A weight of a point on a facet is zero but for round-off.
constexpr double kOnFacet = -1e-12;
// Walks go round in circles on some meshes that are not Delaunay's; most take two or three steps.
constexpr int kMostSteps = 1000;

}  // namespace

CellWalk::Hit CellWalk::find(CellId start, const Vec3& p,
                             const std::vector<bool>& is_allowed) const {
  Hit hit{start, barycentric_coordinates(corners(mesh_, start), p), 0.0};
  for (int step = 0; step < kMostSteps; ++step) {
    MENISCUS_ASSERT(is_allowed[static_cast<std::size_t>(mesh_.region[hit.cell].value)], "cell {}",
                    hit.cell.value);
    CellId next;
    double least = kOnFacet;
    for (std::size_t k = 0; k < 4; ++k) {
      const CellId across = facets_.neighbours(hit.cell)[k];
      if (hit.weights[k] >= least || !across.is_valid() ||
          !is_allowed[static_cast<std::size_t>(mesh_.region[across].value)])
        continue;
      least = hit.weights[k];
      next = across;
    }
    if (!next.is_valid()) break;
    hit.cell = next;
    hit.weights = barycentric_coordinates(corners(mesh_, next), p);
  }
  if (std::ranges::min(hit.weights) >= kOnFacet) return hit;
  const TetPoint nearest = closest_point(corners(mesh_, hit.cell), p);
  return {hit.cell, nearest.weights, (nearest.point - p).squaredNorm()};
}

}  // namespace meniscus
