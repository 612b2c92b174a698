#include "meniscus/surface/foreseen_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

std::string words(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
}

}  // namespace

ForeseenVertices foresee_vertices(const SurfaceMesh& mesh, const VertexField<double>& length) {
  ForeseenVertices result;
  double by_area = 0.0, by_edges = 0.0, most = -1.0;
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    const double area = face_area_vector(mesh, f).stableNorm();
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      by_area += area / 3.0 * density_of_length(length[a]);
      if (a > b) continue;  // once, of the two faces at the edge
      const double l = 0.5 * (length[a] + length[b]),
                   pieces = (mesh.x[b] - mesh.x[a]).stableNorm() / l;
      by_edges += std::max(0.0, pieces - 1.0);
      if (pieces <= most) continue;
      most = pieces;
      result.a = a;
      result.b = b;
      result.length = l;
    }
  }
  result.number = std::max(by_area, by_edges);
  if (!std::isfinite(by_area + by_edges)) result.number = std::numeric_limits<double>::infinity();
  return result;
}

ForeseenVertices foresee_vertices(const SurfaceMesh& mesh, double length) {
  return foresee_vertices(mesh, VertexField<double>(mesh.num_vertices(), length));
}

std::string too_many(const ForeseenVertices& vertices, const SurfaceMesh& mesh) {
  const Vec3 &a = mesh.x[vertices.a], &b = mesh.x[vertices.b];
  return fmt::format(
      "it would take {:.2g} vertices; at most {:.0g} are made: the edge from vertex {} at {} to "
      "vertex {} "
      "at {} is {:.3g} long, and edges of {:.3g} are wanted there",
      vertices.number, kMostVertices, vertices.a.value, words(a), vertices.b.value, words(b),
      (b - a).stableNorm(), vertices.length);
}

}  // namespace meniscus
