#include "meniscus/topology/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/triangle.hpp"

namespace meniscus {
namespace {

using EdgeKey = std::pair<VertexId, VertexId>;

/// Where the plane crosses one face, from the edge it enters by to the edge it leaves by. The order
/// is the one that keeps the side above the plane on the left. Faces share the points of their
/// edges.
struct Crossing {
  EdgeKey from, to;
  FaceId face;
  bool is_followed = false;
};
/// Crossings in rising order of the edges they come from.
using Crossings = std::vector<Crossing>;

/// The crossing that comes from an edge, or none if it was followed or not looked at.
Crossing* crossing_from(Crossings& crossings, const EdgeKey& edge) {
  const auto found = std::ranges::lower_bound(crossings, edge, {}, &Crossing::from);
  return found != crossings.end() && found->from == edge && !found->is_followed ? &*found : nullptr;
}

EdgeKey key(VertexId a, VertexId b) { return a < b ? EdgeKey{a, b} : EdgeKey{b, a}; }

struct Plane {
  Vec3 origin, normal;
  [[nodiscard]] double height(const Vec3& x) const { return normal.dot(x - origin); }
};

/// A vertex in the plane counts as above it, so that every curve passes through edges alone.
Crossings crossings_near(const SurfaceMesh& mesh, const SurfaceTree& tree, const Plane& plane,
                         double reach) {
  Crossings result;
  const Vec3 half = Vec3::Constant(reach);
  const Vec3 low = plane.origin - half, high = plane.origin + half;
  tree.visit_slice(low, high, plane.origin, plane.normal, [&](FaceId f, const Triangle& x) {
    const std::array<bool, 3> is_above{plane.height(x[0]) >= 0.0, plane.height(x[1]) >= 0.0,
                                       plane.height(x[2]) >= 0.0};
    if (is_above[0] == is_above[1] && is_above[1] == is_above[2]) return true;
    const FaceVertices& v = mesh.faces[f];
    EdgeKey up{}, down{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (is_above[k] != is_above[next]) (is_above[next] ? up : down) = key(v[k], v[next]);
    }
    result.push_back({up, down, f});
    return true;
  });
  std::ranges::sort(result, {}, &Crossing::from);
  return result;
}

Vec3 crossing_point(const SurfaceMesh& mesh, const Plane& plane, const EdgeKey& edge) {
  const Vec3 &a = mesh.x[edge.first], &b = mesh.x[edge.second];
  const double ha = plane.height(a), hb = plane.height(b);
  MENISCUS_ASSERT((ha >= 0.0) != (hb >= 0.0), "heights {} and {}", ha, hb);
  return a + ha / (ha - hb) * (b - a);
}

/// Follows the curve from one edge; empty when it leaves the faces that were looked at.
Section curve_from(const SurfaceMesh& mesh, const Plane& plane, EdgeKey start, Crossings& crossings,
                   bool& is_closed) {
  Section section;
  section.axis = plane.normal;
  EdgeKey at = start;
  is_closed = false;
  while (Crossing* crossing = crossing_from(crossings, at)) {
    section.points.push_back(crossing_point(mesh, plane, at));
    section.faces.push_back(crossing->face);
    MENISCUS_ASSERT(section.faces.size() <= crossings.size(), "a curve that goes round twice");
    at = crossing->to;
    crossing->is_followed = true;
    if (at == start) {
      is_closed = true;
      break;
    }
  }
  return section;
}

void measure(Section& section) {
  MENISCUS_ASSERT(!section.points.empty() && section.points.size() == section.faces.size(), "{} {}",
                  section.points.size(), section.faces.size());
  double perimeter = 0.0;
  Vec3 moment = Vec3::Zero(), area = Vec3::Zero();
  for (std::size_t k = 0; k < section.points.size(); ++k) {
    const Vec3 &a = section.points[k], &b = section.points[(k + 1) % section.points.size()];
    const double length = (b - a).norm();
    perimeter += length;
    area += 0.5 * (a - section.points.front()).cross(b - section.points.front());
    moment += 0.5 * length * (a + b);
  }
  section.radius = perimeter / (2.0 * std::numbers::pi);
  section.area = std::abs(area.dot(section.axis));
  section.center = perimeter > 0.0 ? Vec3(moment / perimeter) : section.points.front();
}

/// Turns that the curve makes around `center`, seen along its axis.
double turns_around(const Section& section, const Vec3& center) {
  double angle = 0.0;
  for (std::size_t k = 0; k < section.points.size(); ++k) {
    const Vec3 a = section.points[k] - center,
               b = section.points[(k + 1) % section.points.size()] - center;
    angle += std::atan2(section.axis.dot(a.cross(b)), a.dot(b));
  }
  return angle / (2.0 * std::numbers::pi);
}

double distance_to(const Section& section, const Vec3& center) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& x : section.points) nearest = std::min(nearest, (x - center).norm());
  return nearest;
}

}  // namespace

SectionResult section_around(const SurfaceMesh& mesh, const SurfaceTree& tree, const Vec3& center,
                             const Vec3& axis, double reach) {
  const Plane plane{center, axis};
  Crossings crossings = crossings_near(mesh, tree, plane, reach);
  SectionResult best;
  std::pair<bool, double> best_rank{true, std::numeric_limits<double>::infinity()};
  for (const Crossing& crossing : crossings) {
    if (crossing.is_followed) continue;
    bool is_closed = false;
    Section section = curve_from(mesh, plane, crossing.from, crossings, is_closed);
    const bool goes_around = is_closed && std::abs(turns_around(section, center)) > 0.5;
    const std::pair<bool, double> rank{!goes_around, distance_to(section, center)};
    if (rank >= best_rank) continue;
    best_rank = rank;
    best.kind = is_closed ? SectionKind::closed : SectionKind::wide;
    best.section = std::move(section);
  }
  if (best.kind == SectionKind::closed) measure(best.section);
  return best;
}

double smooth_area(const Section& section, const SurfaceMesh& mesh, const SmoothSurface& surface) {
  const std::size_t n = section.points.size();
  double doubled = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const FaceId f = section.faces[k];
    const FaceVertices& v = mesh.faces[f];
    const Triangle corners{mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]};
    const auto from_center = [&](const Vec3& x) -> Vec3 {
      return surface.point(f, closest_point(corners, x).weights) - section.center;
    };
    const Vec3 &p = section.points[k], &q = section.points[(k + 1) % n];
    const Vec3 a = from_center(p), m = from_center(0.5 * (p + q)), b = from_center(q);
    // The sector to the chord, and 4/3 of the triangle over the chord.
    doubled += section.axis.dot(a.cross(b)) + 4.0 / 3.0 * section.axis.dot((m - a).cross(b - a));
  }
  return 0.5 * std::abs(doubled);
}

}  // namespace meniscus
