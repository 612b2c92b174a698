#include "meniscus/surface/surface_walk.hpp"

#include <Eigen/Geometry>

namespace meniscus {
namespace {

constexpr double kInside = -1e-13;  // round-off of a barycentric coordinate
constexpr int kMaxFaces = 64;       // a walk turns in circles only above the tip of a sharp cone

Vec3 clamped_weights(const Vec3& b) {
  const Vec3 inside = b.cwiseMax(0.0);
  return inside / inside.sum();
}

std::size_t corner_without(const FaceVertices& face, VertexId a, VertexId b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (face[k] != a && face[k] != b) return k;
  return 0;
}

}  // namespace

SurfaceWalk::SurfaceWalk(const SurfaceMesh& mesh, const SurfaceTopology& topology)
    : x_(mesh.x), charts_(mesh.num_faces()) {
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    const Vec3 &x0 = mesh.x[v[0]], e1 = mesh.x[v[1]] - x0, e2 = mesh.x[v[2]] - x0;
    const Vec3 normal = e1.cross(e2);
    const double squared = normal.squaredNorm();
    charts_[f] = {.g1 = e2.cross(normal) / squared,
                  .g2 = normal.cross(e1) / squared,
                  .corners = v,
                  .neighbour = {}};
  }
  for (const SurfaceEdge& e : topology.edges()) {
    charts_[e.left].neighbour[corner_without(mesh.faces[e.left], e.a, e.b)] = e.right;
    charts_[e.right].neighbour[corner_without(mesh.faces[e.right], e.a, e.b)] = e.left;
  }
}

SurfacePoint SurfaceWalk::destination(const SurfacePoint& start, const Vec3& d) const {
  const Vec3 target = flat_point(start) + d;
  FaceId face = start.face, previous;
  for (int step = 0;; ++step) {
    const Chart& chart = charts_[face];
    const Vec3 offset = target - x_[chart.corners[0]];
    const double b1 = chart.g1.dot(offset), b2 = chart.g2.dot(offset);
    const Vec3 b(1.0 - b1 - b2, b1, b2);
    int lowest = 0;
    if (b.minCoeff(&lowest) >= kInside) return {face, clamped_weights(b)};
    const FaceId next = chart.neighbour[static_cast<std::size_t>(lowest)];
    if (next == previous || step == kMaxFaces) return {face, clamped_weights(b)};
    previous = face;
    face = next;
  }
}

}  // namespace meniscus
