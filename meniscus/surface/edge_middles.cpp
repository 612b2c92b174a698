#include "meniscus/surface/edge_middles.hpp"

#include <algorithm>
#include <span>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/rings.hpp"
#include "meniscus/surface/spline_patch.hpp"

namespace meniscus {
namespace {

/// The vertices in the two rings of both ends.
void gather(RingGatherer& rings, const SurfaceEdge& edge, std::vector<Vec3>& points) {
  points.clear();
  for (const VertexId end : {edge.a, edge.b})
    for (const Vec3& p : rings.gather(end, true)) points.push_back(p);
}

std::vector<Vec3> straight_middles(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  std::vector<Vec3> middles;
  middles.reserve(topology.edges().size());
  for (const SurfaceEdge& edge : topology.edges())
    middles.emplace_back(0.5 * (mesh.x[edge.a] + mesh.x[edge.b]));
  return middles;
}

/// Those of the edges from number `first` to before `end`, each by its coordinates.
std::vector<double> middles_on_splines(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                       const SmoothSurface& smooth, std::size_t first,
                                       std::size_t end) {
  MENISCUS_ASSERT(first <= end && end <= topology.edges().size(), "edges {} to {} of {}", first,
                  end, topology.edges().size());
  const VertexField<VertexCurvature>& curvature = smooth.vertex_curvature();
  RingGatherer rings(mesh, topology);
  std::vector<Vec3> points;
  std::vector<double> coordinates;
  coordinates.reserve(3 * (end - first));
  for (const SurfaceEdge& edge : std::span(topology.edges()).subspan(first, end - first)) {
    const VertexCurvature &at_a = curvature[edge.a], &at_b = curvature[edge.b];
    const Vec3 a = mesh.x[edge.a], b = mesh.x[edge.b];
    gather(rings, edge, points);
    const Vec3 n = (at_a.n + at_b.n).normalized();
    const HeightPatch axes = flat_patch(smooth.edge_point(edge.a, edge.b, 0.5), n);
    const Mat3 tensor = 0.5 * (curvature_tensor(at_a, n) + curvature_tensor(at_b, n));
    const Vec3 middle =
        point_on_spline(axes, osculating_quadric(axes, tensor), points,
                        SplinePatch::Coordinates::flat, 0.5 * (a + b), (b - a).norm());
    coordinates.insert(coordinates.end(), middle.begin(), middle.end());
  }
  return coordinates;
}

}  // namespace

FaceField<std::array<std::size_t, 3>> face_edges(const SurfaceMesh& mesh,
                                                 const SurfaceTopology& topology) {
  FaceField<std::array<std::size_t, 3>> edges(mesh.num_faces());
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const SurfaceEdge& edge = topology.edges()[e];
    for (const auto& [f, from] : {std::pair{edge.left, edge.a}, std::pair{edge.right, edge.b}}) {
      const FaceVertices& v = mesh.faces[f];
      const auto k = static_cast<std::size_t>(std::ranges::find(v, from) - v.begin());
      MENISCUS_ASSERT(k < 3, "edge {} does not leave vertex {} of face {}", e, from.value, f.value);
      edges[f][k] = e;
    }
  }
  return edges;
}

std::vector<Vec3> edge_middles(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                               const SmoothSurface& smooth, SurfaceShape shape) {
  switch (shape) {
    case SurfaceShape::faceted:
      break;
    case SurfaceShape::patched:
      return middles_on_patches(smooth, topology);
    case SurfaceShape::splined:
      return middles_on_splines(mesh, topology, smooth);
  }
  return straight_middles(mesh, topology);
}

std::vector<Vec3> middles_on_patches(const SmoothSurface& smooth, const SurfaceTopology& topology) {
  std::vector<Vec3> middles;
  middles.reserve(topology.edges().size());
  for (const SurfaceEdge& edge : topology.edges())
    middles.push_back(smooth.edge_point(edge.a, edge.b, 0.5));
  return middles;
}

std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  return middles_on_splines(mesh, topology, SmoothSurface(mesh, topology));
}

std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                     const SmoothSurface& smooth, const ShareNumbers& share) {
  const std::size_t count = topology.edges().size();
  const std::vector<double> found = share(count, 3, [&](std::size_t first, std::size_t end) {
    return middles_on_splines(mesh, topology, smooth, first, end);
  });
  std::vector<Vec3> middles;
  middles.reserve(count);
  for (std::size_t e = 0; e < count; ++e) middles.emplace_back(&found[3 * e]);
  return middles;
}

}  // namespace meniscus
