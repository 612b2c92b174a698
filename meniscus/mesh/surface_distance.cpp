#include "meniscus/mesh/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <queue>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {
namespace {

constexpr double kCover = 0.58;     // 1/√3 for an equilateral triangle; its corners lie at 1
constexpr double kTouching = 1e-3;  // of the absolute error: no direction to be had from less

/// A point of the first surface with the nearest point of the second.
struct Sample {
  Vec3 x;
  SurfaceTree::Hit nearest;
};

/// Part of a face of the first surface.
struct Part {
  std::array<Sample, 3> corners;
  double upper;  // of the distance of its points, as far as its samples tell
  std::int64_t number;
  /// Order of the queue: the largest bound first, equal ones in the order they were made.
  friend bool operator<(const Part& p, const Part& q) {
    return p.upper != q.upper ? p.upper < q.upper : p.number > q.number;
  }
};

class DistanceSearch {
 public:
  DistanceSearch(const SurfaceMesh& a, const SurfaceMesh& b, const DistanceOptions& options)
      : a_(a), b_(b), tree_(b), options_(options) {
    Vec3 low = tree_.low(), high = tree_.high();
    for (const Vec3& x : a.x) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    absolute_ = options.absolute_error * (high - low).norm();
  }

  SampledDistance run() {
    start();
    for (int split = 0; split < options_.max_splits && !is_done(); ++split) {
      const Part worst = parts_.top();
      parts_.pop();
      quarter(worst);
    }
    if (!parts_.empty()) best_.error = std::max(best_.error, parts_.top().upper - best_.distance);
    best_.error = std::max(0.0, std::max(best_.error, dropped_ - best_.distance));
    return best_;
  }

 private:
  [[nodiscard]] double goal() const {
    return best_.distance + std::max(absolute_, options_.relative_error * best_.distance);
  }
  [[nodiscard]] bool is_done() const { return parts_.empty() || parts_.top().upper <= goal(); }

  Sample sample(const Vec3& x) {
    Sample result{x, tree_.closest(x)};
    if (result.nearest.distance > best_.distance)
      best_ = {result.nearest.distance, 0.0, x, result.nearest.point};
    return result;
  }

  /// How fast the distance from b changes along a face of a with unit normal n, at a sample.
  [[nodiscard]] double slope(const Sample& s, const Vec3& n) const {
    const FaceVertices& v = b_.faces[s.nearest.face];
    const Vec3 across = (b_.x[v[1]] - b_.x[v[0]]).cross(b_.x[v[2]] - b_.x[v[0]]).normalized();
    const double of_face = across.cross(n).norm();
    if (s.nearest.distance <= kTouching * absolute_) return of_face;
    // Nearest to an edge or a corner of b the gradient has the direction of the way there.
    const Vec3 way = (s.x - s.nearest.point) / s.nearest.distance;
    return std::max(of_face, way.cross(n).norm());
  }

  /// Every point of a triangle is nearer than kCover of the centre's distance from the farthest
  /// corner to a corner or the centre.
  [[nodiscard]] double likely_bound(const std::array<Sample, 3>& corners) {
    const Sample middle = sample((corners[0].x + corners[1].x + corners[2].x) / 3.0);
    const Vec3 n = (corners[1].x - corners[0].x).cross(corners[2].x - corners[0].x).normalized();
    double largest = middle.nearest.distance, steepest = slope(middle, n), reach = 0.0;
    for (const Sample& corner : corners) {
      largest = std::max(largest, corner.nearest.distance);
      steepest = std::max(steepest, slope(corner, n));
      reach = std::max(reach, (corner.x - middle.x).norm());
    }
    return largest + kCover * reach * steepest;
  }

  void add(const std::array<Sample, 3>& corners) {
    const double upper = likely_bound(corners);
    if (upper > goal())
      parts_.push({corners, upper, count_++});
    else
      dropped_ = std::max(dropped_, upper);
  }

  void start() {
    VertexField<Sample> samples(a_.num_vertices());
    for (const VertexId v : a_.x.ids()) samples[v] = sample(a_.x[v]);
    for (const FaceVertices& v : a_.faces) add({samples[v[0]], samples[v[1]], samples[v[2]]});
  }

  void quarter(const Part& part) {
    const auto& [p, q, r] = part.corners;
    const Sample pq = sample(0.5 * (p.x + q.x)), qr = sample(0.5 * (q.x + r.x)),
                 rp = sample(0.5 * (r.x + p.x));
    add({p, pq, rp});
    add({pq, q, qr});
    add({rp, qr, r});
    add({pq, qr, rp});
  }

  const SurfaceMesh &a_, &b_;
  SurfaceTree tree_;
  DistanceOptions options_;
  double absolute_ = 0.0;
  SampledDistance best_;
  double dropped_ = 0.0;  // the largest bound of a part that was not looked into
  std::int64_t count_ = 0;
  std::priority_queue<Part> parts_;
};

}  // namespace

SampledDistance directed_distance(const SurfaceMesh& a, const SurfaceMesh& b,
                                  const DistanceOptions& options) {
  return DistanceSearch(a, b, options).run();
}

SampledDistance hausdorff_distance(const SurfaceMesh& a, const SurfaceMesh& b,
                                   const DistanceOptions& options) {
  const SampledDistance there = directed_distance(a, b, options),
                        back = directed_distance(b, a, options);
  SampledDistance larger = there;
  if (back.distance > there.distance) larger = {back.distance, 0.0, back.to, back.from};
  larger.error =
      std::max(there.distance + there.error, back.distance + back.error) - larger.distance;
  return larger;
}

}  // namespace meniscus
