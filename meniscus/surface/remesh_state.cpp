#include "meniscus/surface/remesh_state.hpp"

#include <Eigen/Geometry>

namespace meniscus {
namespace {

/// Cosine between a face and the surface normal at its corners below which it counts as folded:
/// 60°. A face whose corners span an arc of 60° of a circle, as coarse as remeshing goes, has 30°.
constexpr double kUprightCosine = 0.5;

}  // namespace

RemeshVertex vertex_at(const RemeshReference& reference, const SurfaceLocation& place) {
  const SmoothSurface& surface = reference.surface;
  const FaceVertices& v = surface.corners(place.face);
  double length = 0.0;
  for (int k = 0; k < 3; ++k)
    length += place.weights[k] * reference.rest_length[v[static_cast<std::size_t>(k)]];
  return {.x = surface.point(place),
          .rest_length = length,
          .n = surface.linear_normal(place),
          .place = place};
}

RemeshVertex halfway(const RemeshReference& reference, const RemeshVertex& a,
                     const RemeshVertex& b) {
  const Vec3 half =
      0.5 * (reference.surface.flat_point(b.place) - reference.surface.flat_point(a.place));
  return vertex_at(reference, reference.walk.moved(a.place, half));
}

bool is_upright(const RemeshVertex& a, const RemeshVertex& b, const RemeshVertex& c) {
  const Vec3 area = (b.x - a.x).cross(c.x - a.x);
  const double least = kUprightCosine * area.norm();
  return area.dot(a.n) > least && area.dot(b.n) > least && area.dot(c.n) > least;
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
