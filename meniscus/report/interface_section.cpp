#include "meniscus/report/interface_section.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::report {
namespace {

using Edge = std::pair<VertexId, VertexId>;  ///< the lower id first

Edge edge_between(VertexId a, VertexId b) { return std::minmax(a, b); }

/// The faces of one drop, with all vertices of the frame.
SurfaceMesh faces_of_drop(const SurfaceFrame& frame, int drop) {
  SurfaceMesh mesh{.x = frame.mesh.x, .faces = {}};
  for (const FaceId f : frame.mesh.faces.ids()) {
    if (frame.drop[f] == drop) mesh.faces.add(frame.mesh.faces[f]);
  }
  return mesh;
}

/// For each edge that the plane cuts, the next one along the section. A face that the plane cuts
/// has one edge going down through it and one going up; its neighbour sees the latter going down.
std::map<Edge, Edge> section_links(const SurfaceMesh& mesh, double z) {
  std::map<Edge, Edge> next;
  for (const FaceVertices& face : mesh.faces) {
    Edge down, up;
    bool is_cut = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = face[k], b = face[(k + 1) % 3];
      const bool is_a_above = mesh.x[a].z() >= z, is_b_above = mesh.x[b].z() >= z;
      if (is_a_above == is_b_above) continue;
      is_cut = true;
      (is_a_above ? down : up) = edge_between(a, b);
    }
    if (is_cut) next[down] = up;
  }
  return next;
}

Vec3 crossing(const SurfaceMesh& mesh, const Edge& edge, double z) {
  const Vec3 &a = mesh.x[edge.first], &b = mesh.x[edge.second];
  return a + (z - a.z()) / (b.z() - a.z()) * (b - a);
}

void add_point(Curve& curve, double x, double y) {
  curve.x.push_back(x);
  curve.y.push_back(y);
}

/// Follows the links round, one closed curve after the other.
void add_loops(Curve& curve, const SurfaceMesh& mesh, double z) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::map<Edge, Edge> next = section_links(mesh, z);
  while (!next.empty()) {
    const Edge start = next.begin()->first;
    for (auto link = next.begin(); link != next.end();) {
      const Vec3 x = crossing(mesh, link->first, z);
      add_point(curve, x.x(), x.y());
      const Edge following = link->second;
      next.erase(link);
      link = next.find(following);
    }
    const Vec3 x = crossing(mesh, start, z);
    add_point(curve, x.x(), x.y());
    add_point(curve, nan, nan);
  }
}

}  // namespace

Curve section_through_centroids(const SurfaceFrame& frame) {
  Curve curve;
  const std::set<int> drops(frame.drop.begin(), frame.drop.end());
  for (const int drop : drops) {
    const SurfaceMesh mesh = faces_of_drop(frame, drop);
    add_loops(curve, mesh, enclosed_centroid(mesh).z());
  }
  return curve;
}

}  // namespace meniscus::report
