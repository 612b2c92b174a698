#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include "meniscus/core/vec.hpp"

namespace meniscus {

struct SurfaceMesh;

using Box = Eigen::AlignedBox3d;

/// The smallest box around the vertices of a surface.
[[nodiscard]] Box bounding_box(const SurfaceMesh& mesh);

/// A tree over boxes, named by their index in the list it was built from. O(n log n) to build,
/// O(log n + k) for a query that k boxes answer. Queries visit in an order that the boxes decide.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);

  /// The distance of a point from box i; zero within it.
  [[nodiscard]] double distance(std::size_t i, const Vec3& point) const {
    return boxes_[i].exteriorDistance(point);
  }
  /// Calls visit(i) for every box i that is nearer to `query` than `reach` or just as near.
  template <class Visit>
  void visit_within(const Box& query, double reach, const Visit& visit) const;
  /// The boxes before box i in the list that are nearer to it than `reach` or just as near, in
  /// rising order.
  [[nodiscard]] std::vector<std::size_t> earlier_within(std::size_t i, double reach) const;
  /// min over i of value(i), +max of double without boxes. No value(i) may be below bound(d), d the
  /// distance of a point from box i, which must not fall with d. Boxes that cannot hold the least
  /// value are not asked.
  template <class Bound, class Value>
  [[nodiscard]] double least(const Vec3& point, const Bound& bound, const Value& value) const;

 private:
  // NOLINTBEGIN(readability-identifier-naming): the names that Eigen's searches call
  template <class Visit>
  struct Intersector {
    bool intersectVolume(const Box& box) const {
      return box.squaredExteriorDistance(query) <= squared_reach;
    }
    bool intersectObject(int i) const {
      const auto index = static_cast<std::size_t>(i);
      if (intersectVolume(boxes[index])) visit(index);
      return false;  // go on
    }
    const std::vector<Box>& boxes;
    const Box& query;
    double squared_reach;
    const Visit& visit;
  };
  template <class Bound, class Value>
  struct Minimizer {
    using Scalar = double;
    double minimumOnVolume(const Box& box) const { return bound(box.exteriorDistance(point)); }
    double minimumOnObject(int i) {
      const auto index = static_cast<std::size_t>(i);
      if (minimumOnVolume(boxes[index]) < best) best = std::min(best, value(index));
      return best;
    }
    const std::vector<Box>& boxes;
    const Vec3& point;
    const Bound& bound;
    const Value& value;
    double best = std::numeric_limits<double>::max();
  };
  // NOLINTEND(readability-identifier-naming)

  std::vector<Box> boxes_;
  Eigen::KdBVH<double, 3, int> tree_;
};

template <class Visit>
void BoxTree::visit_within(const Box& query, double reach, const Visit& visit) const {
  Intersector<Visit> intersector{boxes_, query, reach * reach, visit};
  if (!boxes_.empty()) Eigen::BVIntersect(tree_, intersector);
}

template <class Bound, class Value>
double BoxTree::least(const Vec3& point, const Bound& bound, const Value& value) const {
  Minimizer<Bound, Value> minimizer{boxes_, point, bound, value};
  if (!boxes_.empty()) Eigen::BVMinimize(tree_, minimizer);
  return minimizer.best;
}

}  // namespace meniscus
