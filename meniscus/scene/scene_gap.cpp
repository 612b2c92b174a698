#include "meniscus/scene/scene_gap.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/box_tree.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {
namespace {

/// Keeps what rounding puts beyond the least distance so far, so that order does not matter.
constexpr double kRoundOff = 1.0 + 1e-12;

std::vector<const SurfaceMesh*> surfaces_of(const Scene& scene) {
  std::vector<const SurfaceMesh*> surfaces;
  surfaces.reserve(scene.interfaces.size() + 1);
  for (const Interface& interface : scene.interfaces) surfaces.push_back(&interface.mesh);
  if (!scene.is_unbounded) surfaces.push_back(&scene.boundary.mesh);
  return surfaces;
}

/// The vertices of a surface, those furthest from a point first.
std::vector<Vec3> furthest_first(const SurfaceMesh& surface, const Vec3& point) {
  std::vector<Vec3> vertices(surface.x.begin(), surface.x.end());
  std::ranges::sort(vertices, std::greater(),
                    [&](const Vec3& x) { return (x - point).squaredNorm(); });
  return vertices;
}

}  // namespace

std::optional<double> smallest_gap(const Scene& scene) {
  const std::vector<const SurfaceMesh*> surfaces = surfaces_of(scene);
  if (surfaces.size() < 2) return std::nullopt;
  std::vector<SurfaceTree> trees;
  std::vector<Box> bounds;
  for (const SurfaceMesh* surface : surfaces) {
    const SurfaceTree& tree = trees.emplace_back(*surface);
    bounds.emplace_back(tree.low(), tree.high());
  }
  const BoxTree boxes(bounds);
  /// From x to the other surfaces, if that is less than `within`.
  const auto distance = [&](std::size_t i, const Vec3& x, double within) {
    boxes.visit_within(Box(x), within, [&](std::size_t j) {
      if (j != i) within = std::min(within, trees[j].closest(x, within).distance);
    });
    return within;
  };
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Vec3 middle = bounds[i].center();
    const double radius = 0.5 * bounds[i].diagonal().norm();
    const double from_middle = distance(i, middle, gap + radius);
    for (const Vec3& x : furthest_first(*surfaces[i], middle)) {
      // No way to the others is shorter than that from the middle by more than the way to it.
      if (from_middle - (x - middle).norm() >= gap * kRoundOff) break;
      gap = std::min(gap, distance(i, x, gap * kRoundOff));
    }
  }
  return gap;
}

}  // namespace meniscus
