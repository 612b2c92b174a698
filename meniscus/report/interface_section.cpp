#include "meniscus/report/interface_section.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::report {
namespace {

using Edge = std::pair<VertexId, VertexId>;  ///< the lower id first

/// The plane x[normal] = offset.
struct Plane {
  int normal = 2;
  double offset = 0.0;
  [[nodiscard]] double height(const Vec3& x) const { return x[normal] - offset; }
};

Edge edge_between(VertexId a, VertexId b) { return std::minmax(a, b); }

/// The faces of one drop on all vertices of the frame.
SurfaceMesh faces_of_drop(const SurfaceFrame& frame, int drop) {
  SurfaceMesh mesh{.x = frame.mesh.x, .faces = {}};
  for (const FaceId f : frame.mesh.faces.ids()) {
    if (frame.drop[f] == drop) mesh.faces.add(frame.mesh.faces[f]);
  }
  return mesh;
}

/// For each edge that the plane cuts, the next edge along the section. A cut face has one edge
/// going down through the plane and one going up; its neighbour sees the latter going down.
std::map<Edge, Edge> section_links(const SurfaceMesh& mesh, const Plane& plane) {
  std::map<Edge, Edge> next;
  for (const FaceVertices& face : mesh.faces) {
    Edge down, up;
    bool is_cut = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = face[k], b = face[(k + 1) % 3];
      const bool is_a_above = plane.height(mesh.x[a]) >= 0.0,
                 is_b_above = plane.height(mesh.x[b]) >= 0.0;
      if (is_a_above == is_b_above) continue;
      is_cut = true;
      (is_a_above ? down : up) = edge_between(a, b);
    }
    if (is_cut) next[down] = up;
  }
  return next;
}

Vec3 crossing(const SurfaceMesh& mesh, const Edge& edge, const Plane& plane) {
  const Vec3 &a = mesh.x[edge.first], &b = mesh.x[edge.second];
  const double below = plane.height(a), above = plane.height(b);
  return a - below / (above - below) * (b - a);
}

void add_point(Curve& curve, double x, double y) {
  curve.x.push_back(x);
  curve.y.push_back(y);
}

/// Appends the closed curves of the section, following its links.
void add_loops(Curve& curve, const SurfaceMesh& mesh, const Plane& plane) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::map<Edge, Edge> next = section_links(mesh, plane);
  while (!next.empty()) {
    const Edge start = next.begin()->first;
    for (auto link = next.begin(); link != next.end();) {
      const Vec3 x = crossing(mesh, link->first, plane);
      add_point(curve, x.x(), x[3 - plane.normal]);
      const Edge following = link->second;
      next.erase(link);
      link = next.find(following);
    }
    const Vec3 x = crossing(mesh, start, plane);
    add_point(curve, x.x(), x[3 - plane.normal]);
    add_point(curve, nan, nan);
  }
}

}  // namespace

Curve section_through_centroids(const SurfaceFrame& frame, int normal) {
  MENISCUS_ASSERT(normal == 1 || normal == 2, "a section normal to axis {}", normal);
  Curve curve;
  const std::set<int> drops(frame.drop.begin(), frame.drop.end());
  for (const int drop : drops) {
    const SurfaceMesh mesh = faces_of_drop(frame, drop);
    add_loops(curve, mesh, {normal, enclosed_centroid(mesh)[normal]});
  }
  return curve;
}

}  // namespace meniscus::report
