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

bool boxes_touch(const Vec3& low, const Vec3& high, const Vec3& other_low, const Vec3& other_high) {
  return (low.array() <= other_high.array()).all() && (other_low.array() <= high.array()).all();
}

Vec3 low_corner(const Triangle& x) { return x[0].cwiseMin(x[1]).cwiseMin(x[2]); }
Vec3 high_corner(const Triangle& x) { return x[0].cwiseMax(x[1]).cwiseMax(x[2]); }

float rounded_up(double x) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (x >= std::numeric_limits<float>::max()) return kInfinity;
  return std::nextafter(static_cast<float>(x), kInfinity);
}

/// A ray along the sides of the boxes is within a slab or far from it. So there is no infinity,
/// which a distance of zero would make no number.
Vec3 finite_inverse(const Vec3& direction) {
  return direction.unaryExpr(
      [](double d) { return d == 0.0 ? std::numeric_limits<double>::max() : 1.0 / d; });
}

}  // namespace

/// A face while the tree is built.
struct SurfaceTree::Sorted {
  Vec3 low, high;
  FaceId face;

  [[nodiscard]] double twice_middle(Eigen::Index axis) const { return low[axis] + high[axis]; }
};

SurfaceTree::SurfaceTree(const SurfaceMesh& mesh) {
  MENISCUS_ASSERT(mesh.num_faces() > 0, "a tree needs faces");
  const auto corners = [&](FaceId f) -> Triangle {
    const FaceVertices& v = mesh.faces[f];
    return {mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]};
  };
  std::vector<Sorted> faces;
  faces.reserve(static_cast<std::size_t>(mesh.num_faces()));
  for (const FaceId f : mesh.faces.ids()) {
    const Triangle x = corners(f);
    faces.push_back({low_corner(x), high_corner(x), f});
  }
  nodes_.reserve(faces.size());
  build(faces, 0);
  leaves_.reserve(faces.size());
  for (const Sorted& sorted : faces) leaves_.push_back({corners(sorted.face), sorted.face});
}

void SurfaceTree::build(std::span<Sorted> faces, std::int32_t begin) {
  const auto node = nodes_.size();
  const auto count = static_cast<std::int32_t>(faces.size());
  Vec3 low = faces.front().low, high = faces.front().high;
  double longest = 0.0;
  for (const Sorted& face : faces) {
    low = low.cwiseMin(face.low);
    high = high.cwiseMax(face.high);
    longest = std::max(longest, (face.high - face.low).squaredNorm());
  }
  nodes_.push_back({low, high, rounded_up(longest), begin, begin + count, 0});
  if (count <= kLeafSize) return;
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::int32_t half = count / 2;
  std::ranges::nth_element(faces, faces.begin() + half, {},
                           [axis](const Sorted& face) { return face.twice_middle(axis); });
  build(faces.first(static_cast<std::size_t>(half)), begin);
  nodes_[node].right = static_cast<std::int32_t>(nodes_.size());
  build(faces.subspan(static_cast<std::size_t>(half)), begin + half);
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

struct SurfaceTree::RaySearch {
  const Vec3& origin;
  const Vec3& direction;
  Vec3 inverse;   // 1/direction, finite
  double margin;  // keeps a hit on the very edge of a flat box, which rounding could cut off
  Hit best;

  /// Where the ray enters a box, or infinity.
  [[nodiscard]] double entry(const Node& node) const {
    const Vec3 margins = Vec3::Constant(margin);
    const Vec3 a = (node.low - margins - origin).cwiseProduct(inverse),
               b = (node.high + margins - origin).cwiseProduct(inverse);
    const double enter = std::max(0.0, a.cwiseMin(b).maxCoeff()), leave = a.cwiseMax(b).minCoeff();
    return enter <= leave ? enter : std::numeric_limits<double>::infinity();
  }
};

std::optional<SurfaceTree::Hit> SurfaceTree::first_hit(const Vec3& origin, const Vec3& direction,
                                                       double within) const {
  RaySearch search{
      origin, direction, finite_inverse(direction), 1e-9 * (high() - low()).norm(), {}};
  search.best.distance = within;
  if (search.entry(nodes_.front()) < within) search_ray(0, search);
  if (!search.best.face.is_valid()) return std::nullopt;
  return search.best;
}

void SurfaceTree::search_ray(std::int32_t node, RaySearch& search) const {
  const Node& here = nodes_[static_cast<std::size_t>(node)];
  if (here.right == 0) {
    for (std::int32_t i = here.begin; i < here.end; ++i) {
      const Leaf& leaf = leaves_[static_cast<std::size_t>(i)];
      const std::optional<RayHit> hit =
          intersect_ray(leaf.corners, search.origin, search.direction);
      if (hit && hit->t < search.best.distance)
        search.best = {leaf.face, search.origin + hit->t * search.direction, hit->weights, hit->t};
    }
    return;
  }
  std::int32_t near = node + 1, far = here.right;
  double near_entry = search.entry(nodes_[static_cast<std::size_t>(near)]),
         far_entry = search.entry(nodes_[static_cast<std::size_t>(far)]);
  if (far_entry < near_entry) {
    std::swap(near, far);
    std::swap(near_entry, far_entry);
  }
  if (near_entry < search.best.distance) search_ray(near, search);
  if (far_entry < search.best.distance) search_ray(far, search);
}

/// `is_open` is asked of a box and the squared diagonal of the largest face's box in it.
template <class IsOpen>
void SurfaceTree::visit_where(const IsOpen& is_open, const Visit& visit) const {
  std::array<std::int32_t, kMostOpen> open{};
  std::size_t num_open = 1;
  while (num_open > 0) {
    const std::int32_t node = open[--num_open];
    const Node& here = nodes_[static_cast<std::size_t>(node)];
    if (!is_open(here.low, here.high, here.longest)) continue;
    if (here.right != 0) {
      open[num_open++] = here.right;
      open[num_open++] = node + 1;
      continue;
    }
    for (std::int32_t i = here.begin; i < here.end; ++i) {
      const Leaf& leaf = leaves_[static_cast<std::size_t>(i)];
      const auto& x = leaf.corners;
      const Vec3 low = low_corner(x), high = high_corner(x);
      if (is_open(low, high, (high - low).squaredNorm()) && !visit(leaf.face, x)) return;
    }
  }
}

void SurfaceTree::visit_box(const Vec3& low, const Vec3& high, const Visit& visit) const {
  visit_where([&](const Vec3& other_low, const Vec3& other_high,
                  double) { return boxes_touch(low, high, other_low, other_high); },
              visit);
}

void SurfaceTree::visit_near(const Vec3& x, double reach, const Visit& visit) const {
  visit_where(
      [&](const Vec3& low, const Vec3& high, double longest) {
        return squared_distance_to_box(x, low, high) < reach * reach * longest;
      },
      visit);
}

void SurfaceTree::visit_touching_pairs(const VisitPair& visit) const {
  static_cast<void>(visit_pairs_within(0, visit));
}

bool SurfaceTree::visit_pairs_within(std::int32_t node, const VisitPair& visit) const {
  const Node& here = nodes_[static_cast<std::size_t>(node)];
  if (here.right != 0)
    return visit_pairs_within(node + 1, visit) &&
           visit_pairs_between(node + 1, here.right, visit) &&
           visit_pairs_within(here.right, visit);
  for (std::int32_t i = here.begin; i < here.end; ++i)
    for (std::int32_t j = i + 1; j < here.end; ++j) {
      const Leaf &a = leaves_[static_cast<std::size_t>(i)],
                 &b = leaves_[static_cast<std::size_t>(j)];
      if (boxes_touch(low_corner(a.corners), high_corner(a.corners), low_corner(b.corners),
                      high_corner(b.corners)) &&
          !visit(a.face, a.corners, b.face, b.corners))
        return false;
    }
  return true;
}

bool SurfaceTree::visit_pairs_between(std::int32_t a, std::int32_t b,
                                      const VisitPair& visit) const {
  const Node &first = nodes_[static_cast<std::size_t>(a)],
             &second = nodes_[static_cast<std::size_t>(b)];
  if (!boxes_touch(first.low, first.high, second.low, second.high)) return true;
  if (first.end - first.begin < second.end - second.begin) return visit_pairs_between(b, a, visit);
  if (first.right != 0)
    return visit_pairs_between(a + 1, b, visit) && visit_pairs_between(first.right, b, visit);
  for (std::int32_t i = first.begin; i < first.end; ++i) {
    const Leaf& one = leaves_[static_cast<std::size_t>(i)];
    const Vec3 low = low_corner(one.corners), high = high_corner(one.corners);
    if (!boxes_touch(low, high, second.low, second.high)) continue;
    for (std::int32_t j = second.begin; j < second.end; ++j) {
      const Leaf& other = leaves_[static_cast<std::size_t>(j)];
      if (boxes_touch(low, high, low_corner(other.corners), high_corner(other.corners)) &&
          !visit(one.face, one.corners, other.face, other.corners))
        return false;
    }
  }
  return true;
}

void SurfaceTree::visit_slice(const Vec3& low, const Vec3& high, const Vec3& origin,
                              const Vec3& normal, const Visit& visit) const {
  const Vec3 reach = normal.cwiseAbs();
  visit_where(
      [&](const Vec3& other_low, const Vec3& other_high, double) {
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
