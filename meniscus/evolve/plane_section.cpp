#include "meniscus/evolve/plane_section.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Geometry>

namespace meniscus {
namespace {

/// Cubic Bézier curve of an edge. Its end tangents are the chord projected onto the tangent planes.
class CurvedEdge {
 public:
  CurvedEdge(const Vec3& a, const Vec3& b, const Vec3& normal_a, const Vec3& normal_b)
      : p0_(a),
        p1_(a + ((b - a) - (b - a).dot(normal_a) * normal_a) / 3.0),
        p2_(b - ((b - a) - (b - a).dot(normal_b) * normal_b) / 3.0),
        p3_(b) {}

  [[nodiscard]] Vec3 point(double s) const {
    const double r = 1.0 - s;
    return r * r * r * p0_ + 3.0 * r * r * s * p1_ + 3.0 * r * s * s * p2_ + s * s * s * p3_;
  }

 private:
  Vec3 p0_, p1_, p2_, p3_;
};

/// The point where the curve meets height 0, by bisection and secant to round-off. Its ends must
/// lie on opposite sides.
Vec3 crossing(const CurvedEdge& edge, const auto& height) {
  double low = 0.0, high = 1.0;
  double at_low = height(edge.point(low));
  for (int iteration = 0; iteration < 60 && high - low > 1e-15; ++iteration) {
    const double middle = 0.5 * (low + high), value = height(edge.point(middle));
    if ((value > 0.0) == (at_low > 0.0)) {
      low = middle;
      at_low = value;
    } else {
      high = middle;
    }
  }
  return edge.point(0.5 * (low + high));
}

/// Extremum of |x − origin| on the parabola through three points in turn (parameter: chord length).
/// It is the middle point itself where the parabola has none between them.
ExtremeDistance refine(const Vec3& before, const Vec3& at, const Vec3& after, const Vec3& origin) {
  const double r0 = (before - origin).norm(), r1 = (at - origin).norm(),
               r2 = (after - origin).norm();
  const double h0 = (at - before).norm(), h2 = (after - at).norm();
  if (h0 <= 0.0 || h2 <= 0.0) return {r1, at};
  // r(s) = r1 + b s + c s² through s = −h0, 0, h2.
  const double c = ((r2 - r1) / h2 - (r1 - r0) / h0) / (h0 + h2);
  const double b = (r2 - r1) / h2 - c * h2;
  if (c == 0.0) return {r1, at};
  const double s = std::clamp(-b / (2.0 * c), -h0, h2);
  const double distance = r1 + b * s + c * s * s;
  const Vec3 chord =
      s < 0.0 ? Vec3(at + (before - at) * (-s / h0)) : Vec3(at + (after - at) * (s / h2));
  return {distance, origin + distance * (chord - origin).normalized()};
}

ExtremeDistance extreme_distance(const std::vector<std::vector<Vec3>>& curves, const Vec3& origin,
                                 double sign) {
  std::optional<ExtremeDistance> best;
  for (const auto& curve : curves) {
    const std::size_t n = curve.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 &before = curve[(i + n - 1) % n], &at = curve[i], &after = curve[(i + 1) % n];
      const double r = sign * (at - origin).norm();
      if (n > 2 && (r < sign * (before - origin).norm() || r < sign * (after - origin).norm()))
        continue;
      const ExtremeDistance found =
          n > 2 ? refine(before, at, after, origin) : ExtremeDistance{std::abs(r), at};
      if (!best || sign * found.distance > sign * best->distance) best = found;
    }
  }
  return best.value_or(ExtremeDistance{0.0, origin});
}

}  // namespace

std::vector<std::vector<Vec3>> plane_section(const SurfaceMesh& mesh,
                                             const SurfaceTopology& topology,
                                             const VertexField<VertexCurvature>& fit,
                                             const Vec3& origin, const Vec3& axis) {
  const auto height = [&](const Vec3& x) { return axis.dot(x - origin); };
  const auto is_above = [&](VertexId v) { return height(mesh.x[v]) > 0.0; };
  // A crossing of the plane with an edge; each cut face joins the crossings of two of its edges.
  struct Crossing {
    Vec3 point;
    FaceId left, right;
    bool is_visited = false;
  };
  std::vector<Crossing> crossings;
  std::map<FaceId, std::array<std::size_t, 2>> face_to_crossings;
  std::map<FaceId, std::size_t> found;
  for (const SurfaceEdge& e : topology.edges()) {
    if (is_above(e.a) == is_above(e.b)) continue;
    const CurvedEdge edge(mesh.x[e.a], mesh.x[e.b], fit[e.a].n, fit[e.b].n);
    for (const FaceId f : {e.left, e.right}) face_to_crossings[f][found[f]++] = crossings.size();
    crossings.push_back({crossing(edge, height), e.left, e.right, false});
  }
  std::vector<std::vector<Vec3>> curves;
  for (std::size_t start = 0; start < crossings.size(); ++start) {
    if (crossings[start].is_visited) continue;
    std::vector<Vec3>& curve = curves.emplace_back();
    std::size_t current = start;
    FaceId through = crossings[start].left;
    do {
      crossings[current].is_visited = true;
      curve.push_back(crossings[current].point);
      const auto& pair = face_to_crossings.at(through);
      current = pair[0] == current ? pair[1] : pair[0];
      through =
          crossings[current].left == through ? crossings[current].right : crossings[current].left;
    } while (current != start);
  }
  return curves;
}

ExtremeDistance largest_distance(const std::vector<std::vector<Vec3>>& curves, const Vec3& origin) {
  return extreme_distance(curves, origin, 1.0);
}

ExtremeDistance smallest_distance(const std::vector<std::vector<Vec3>>& curves,
                                  const Vec3& origin) {
  return extreme_distance(curves, origin, -1.0);
}

}  // namespace meniscus
