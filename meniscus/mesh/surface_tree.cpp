#include "meniscus/mesh/surface_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

constexpr std::int32_t kLeafSize = 4;  // measured: 2 to 8 faces per leaf cost the same
// Nodes to be looked at: one for each level but the last; halving 2^31 faces makes 29 of them.
constexpr std::size_t kMostOpen = 64;

double squared_distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

/// Where a ray enters a box, or infinity. A direction component of zero divides to ±infinity, as
/// the slab test wants; 0/0 (a ray within a face of the box) is read as "inside the slab".
double ray_entry(const Vec3& origin, const Vec3& direction, const Vec3& low, const Vec3& high) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double a = (low[k] - origin[k]) / direction[k], b = (high[k] - origin[k]) / direction[k];
    if (std::isnan(a) || std::isnan(b)) continue;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

bool boxes_touch(const Vec3& low, const Vec3& high, const Vec3& other_low, const Vec3& other_high) {
  return (low.array() <= other_high.array()).all() && (other_low.array() <= high.array()).all();
}

}  // namespace

SurfaceTree::SurfaceTree(const SurfaceMesh& mesh) {
  MENISCUS_ASSERT(mesh.num_faces() > 0, "a tree needs faces");
  leaves_.reserve(static_cast<std::size_t>(mesh.num_faces()));
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    leaves_.push_back({{mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]}, f});
  }
  nodes_.reserve(leaves_.size());
  build(0, mesh.num_faces());
}

void SurfaceTree::build(std::int32_t begin, std::int32_t end) {
  const auto node = nodes_.size();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(kInfinity), high = -low;
  for (std::int32_t i = begin; i < end; ++i)
    for (const Vec3& x : leaves_[static_cast<std::size_t>(i)].corners) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  nodes_.push_back({low, high, begin, end, 0});
  if (end - begin <= kLeafSize) return;
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto along = [axis](const Leaf& leaf) {
    return leaf.corners[0][axis] + leaf.corners[1][axis] + leaf.corners[2][axis];
  };
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(leaves_.begin() + begin, leaves_.begin() + middle, leaves_.begin() + end,
                   [&](const Leaf& a, const Leaf& b) { return along(a) < along(b); });
  build(begin, middle);
  nodes_[node].right = static_cast<std::int32_t>(nodes_.size());
  build(middle, end);
}

struct SurfaceTree::ClosestSearch {
  const Vec3& p;
  double shrink;   // (1 + slack)^−2: what is not nearer than the best by that much is not opened
  double squared;  // squared distance of the best so far
  Hit best;
};

SurfaceTree::Hit SurfaceTree::closest(const Vec3& p, double within, double slack) const {
  ClosestSearch search{p, 1.0 / ((1.0 + slack) * (1.0 + slack)), within * within, {}};
  search_closest(0, search);
  if (search.best.face.is_valid()) search.best.distance = std::sqrt(search.squared);
  return search.best;
}

void SurfaceTree::search_closest(std::int32_t node, ClosestSearch& search) const {
  const Node& here = nodes_[static_cast<std::size_t>(node)];
  if (here.right == 0) {
    for (std::int32_t i = here.begin; i < here.end; ++i) {
      const Leaf& leaf = leaves_[static_cast<std::size_t>(i)];
      const TrianglePoint candidate = closest_point(leaf.corners, search.p);
      const double squared = (candidate.point - search.p).squaredNorm();
      if (squared >= search.squared) continue;
      search.squared = squared;
      search.best = {leaf.face, candidate.point, candidate.weights, 0.0};
    }
    return;
  }
  const auto reach = [&](std::int32_t child) {
    const Node& n = nodes_[static_cast<std::size_t>(child)];
    return squared_distance_to_box(search.p, n.low, n.high);
  };
  std::int32_t near = node + 1, far = here.right;
  double near_reach = reach(near), far_reach = reach(far);
  if (far_reach < near_reach) {
    std::swap(near, far);
    std::swap(near_reach, far_reach);
  }
  if (near_reach < search.shrink * search.squared) search_closest(near, search);
  if (far_reach < search.shrink * search.squared) search_closest(far, search);
}

std::optional<SurfaceTree::Hit> SurfaceTree::first_hit(const Vec3& origin, const Vec3& direction,
                                                       double within) const {
  Hit best;
  best.distance = within;
  search_ray(0, origin, direction, best);
  if (!best.face.is_valid()) return std::nullopt;
  return best;
}

void SurfaceTree::search_ray(std::int32_t node, const Vec3& origin, const Vec3& direction,
                             Hit& best) const {
  const Node& here = nodes_[static_cast<std::size_t>(node)];
  // The slack keeps a hit on the very edge of a flat box, which rounding could cut off.
  const double slack = 1e-9 * (here.high - here.low).norm();
  const Vec3 margin = Vec3::Constant(slack);
  if (!(ray_entry(origin, direction, here.low - margin, here.high + margin) < best.distance))
    return;
  if (here.right != 0) {
    search_ray(node + 1, origin, direction, best);
    search_ray(here.right, origin, direction, best);
    return;
  }
  for (std::int32_t i = here.begin; i < here.end; ++i) {
    const Leaf& leaf = leaves_[static_cast<std::size_t>(i)];
    const std::optional<RayHit> hit = intersect_ray(leaf.corners, origin, direction);
    if (hit && hit->t < best.distance)
      best = {leaf.face, origin + hit->t * direction, hit->weights, hit->t};
  }
}

template <class IsOpen>
void SurfaceTree::visit_where(const IsOpen& is_open, const Visit& visit) const {
  std::array<std::int32_t, kMostOpen> open{};
  std::size_t num_open = 1;
  while (num_open > 0) {
    const std::int32_t node = open[--num_open];
    const Node& here = nodes_[static_cast<std::size_t>(node)];
    if (!is_open(here.low, here.high)) continue;
    if (here.right != 0) {
      open[num_open++] = here.right;
      open[num_open++] = node + 1;
      continue;
    }
    for (std::int32_t i = here.begin; i < here.end; ++i) {
      const Leaf& leaf = leaves_[static_cast<std::size_t>(i)];
      const auto& x = leaf.corners;
      if (is_open(x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])) &&
          !visit(leaf.face, x))
        return;
    }
  }
}

void SurfaceTree::visit_box(const Vec3& low, const Vec3& high, const Visit& visit) const {
  visit_where([&](const Vec3& other_low,
                  const Vec3& other_high) { return boxes_touch(low, high, other_low, other_high); },
              visit);
}

void SurfaceTree::visit_slice(const Vec3& low, const Vec3& high, const Vec3& origin,
                              const Vec3& normal, const Visit& visit) const {
  const Vec3 reach = normal.cwiseAbs();
  visit_where(
      [&](const Vec3& other_low, const Vec3& other_high) {
        if (!boxes_touch(low, high, other_low, other_high)) return false;
        const Vec3 half = 0.5 * (other_high - other_low);
        const Vec3 from_origin = other_low + half - origin;
        // The slack keeps a box that touches the plane, whatever the rounding.
        const double slack = 1e-9 * (half.sum() + from_origin.cwiseAbs().sum());
        return std::abs(normal.dot(from_origin)) <= reach.dot(half) + slack;
      },
      visit);
}

}  // namespace meniscus
