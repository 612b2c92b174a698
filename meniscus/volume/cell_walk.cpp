#include "meniscus/volume/cell_walk.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/cell_tree.hpp"

namespace meniscus {
namespace {

// A weight of a point on a facet is zero but for round-off.
constexpr double kOnFacet = -1e-12;
// Walks go round in circles on some meshes that are not Delaunay's; most take two or three steps.
constexpr int kMostSteps = 1000;

}  // namespace

std::array<double, 4> CellWalk::barycentric(CellId c, const Vec3& p) const {
  const TetCorners x = corners(mesh_, c);
  const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0], d = p - x[0];
  const Vec3 n1 = e2.cross(e3);
  const double scale = 1.0 / e1.dot(n1);
  const double b1 = scale * d.dot(n1), b2 = scale * d.dot(e3.cross(e1)),
               b3 = scale * d.dot(e1.cross(e2));
  return {1.0 - b1 - b2 - b3, b1, b2, b3};
}

CellWalk::Hit CellWalk::find(CellId start, const Vec3& p,
                             const std::vector<bool>& is_allowed) const {
  Hit hit{start, barycentric(start, p), 0.0};
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
    hit.weights = barycentric(next, p);
  }
  if (std::ranges::min(hit.weights) >= kOnFacet) return hit;
  const TetPoint nearest = closest_point(corners(mesh_, hit.cell), p);
  return {hit.cell, nearest.weights, (nearest.point - p).squaredNorm()};
}

}  // namespace meniscus
