#include "meniscus/surface/remesh_state.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "meniscus/surface/rings.hpp"
#include "meniscus/surface/spline_patch.hpp"
#include "meniscus/surface/trust.hpp"

namespace meniscus {
namespace {

/// Cosine between a face and the surface normal at its corners below which it counts as folded:
/// 60°. A face whose corners span an arc of 60° of a circle, as coarse as remeshing goes, has 30°.
constexpr double kUprightCosine = 0.5;
/// A patch and a spline farther apart than this, in edges: then the spline is no better known.
/// Patches of a drop of 60 vertices are off by 0.01.
constexpr double kMostShift = 0.05;

}  // namespace

RemeshVertex vertex_at(const RemeshReference& reference, const SurfacePoint& point) {
  const FaceVertices& corners = reference.walk.corners(point.face);
  const Vec3 flat = reference.walk.flat_point(point);
  Vec3 lift = Vec3::Zero(), n = Vec3::Zero();
  double length = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double b = point.weights[static_cast<int>(k)];
    const RemeshReference::Corner& corner = reference.corners[corners[k]];
    const Vec3 back = reference.walk.vertex(corners[k]) - flat;
    lift += b * corner.n.dot(back) * corner.n;
    n += b * corner.n;
    length += b * (corner.rest_length - 0.5 * corner.slope.dot(back));
  }
  return {.x = flat + 0.5 * lift, .rest_length = length, .n = n.normalized(), .point = point};
}

void lift_to_surface(RemeshState& state) {
  for (const VertexId v : state.vertices.ids())
    if (state.mesh.is_alive(v))
      state.vertices[v].x = state.reference.surface.point(state.vertices[v].point);
}

void lift_to_splines(RemeshState& state, const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  const SmoothSurface& surface = state.reference.surface;
  const VertexField<VertexCurvature>& curvature = surface.vertex_curvature();
  RingGatherer rings(mesh, topology);
  std::vector<Vec3> points;
  for (const VertexId v : state.vertices.ids()) {
    if (!state.mesh.is_alive(v)) continue;
    const SurfacePoint& at = state.vertices[v].point;
    const FaceVertices& corners = mesh.faces[at.face];
    const auto [x, n] = surface.at(at);
    points.clear();
    double half_sum = 0.0, longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const Vec3& p : rings.gather(corners[k], true)) points.push_back(p);
      half_sum += at.weights[static_cast<int>(k)] * curvature[corners[k]].half_sum();
      longest = std::max(longest, (mesh.x[corners[k]] - mesh.x[corners[(k + 1) % 3]]).norm());
    }
    const Vec3 shift = point_on_spline(flat_patch(x, n), OsculatingQuadric::sphere(half_sum),
                                       points, SplinePatch::Coordinates::unrolled,
                                       state.reference.walk.flat_point(at), longest) -
                       x;
    state.vertices[v].x = x + trust(shift.norm(), kMostShift * longest) * shift;
  }
}

RemeshVertex halfway(const RemeshReference& reference, const RemeshVertex& a,
                     const RemeshVertex& b) {
  const Vec3 half = 0.5 * (reference.walk.flat_point(b.point) - reference.walk.flat_point(a.point));
  return vertex_at(reference, reference.walk.destination(a.point, half));
}

bool is_consistently_oriented(const RemeshVertex& a, const RemeshVertex& b, const RemeshVertex& c) {
  const Vec3 area = (b.x - a.x).cross(c.x - a.x);
  const double least = std::min({area.dot(a.n), area.dot(b.n), area.dot(c.n)});
  return least > 0.0 && least * least > kUprightCosine * kUprightCosine * area.squaredNorm();
}

RemeshState start_state(const RemeshReference& reference, const SurfaceMesh& mesh,
                        const SurfaceTopology& topology) {
  RemeshState state{reference, EditMesh(mesh, topology),
                    VertexField<RemeshVertex>(mesh.num_vertices())};
  for (const VertexId v : mesh.x.ids()) {
    const FaceId f = topology.faces_around(v)[0];
    const FaceVertices& corners = mesh.faces[f];
    Vec3 weights = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      if (corners[k] == v) weights[static_cast<int>(k)] = 1.0;
    state.vertices[v] = vertex_at(reference, {f, weights});
    state.touch(v);
  }
  return state;
}

}  // namespace meniscus
