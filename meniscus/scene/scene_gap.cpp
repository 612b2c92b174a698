#include "meniscus/scene/scene_gap.hpp"

#include <algorithm>
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
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (const Vec3& x : surfaces[i]->x)
      boxes.visit_within(Box(x), gap * kRoundOff, [&](std::size_t j) {
        if (j != i) gap = std::min(gap, trees[j].closest(x, gap * kRoundOff).distance);
      });
  return gap;
}

}  // namespace meniscus
