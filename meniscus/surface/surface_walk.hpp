#pragma once

#include <array>

#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// Finds points on a triangulation by walking from face to face. The vertices of a remesh move by
/// fractions of an edge. So the next point is a face or two away from the last, and no search tree
/// is needed.
class SurfaceWalk {
 public:
  SurfaceWalk(const SurfaceMesh& mesh, const SurfaceTopology& topology);

  /// The point reached from `start` on its flat face by the displacement d: where the walk from
  /// face to face toward the target ends. Zero displacement returns the start. Beyond an edge that
  /// bends away, where the target is above no face, it is the nearest point on that edge.
  [[nodiscard]] SurfacePoint destination(const SurfacePoint& start, const Vec3& d) const;
  /// The position of a surface point on its flat face.
  [[nodiscard]] Vec3 flat_point(const SurfacePoint& point) const {
    const FaceVertices& v = charts_[point.face].corners;
    return point.weights[0] * x_[v[0]] + point.weights[1] * x_[v[1]] + point.weights[2] * x_[v[2]];
  }
  [[nodiscard]] const FaceVertices& corners(FaceId f) const { return charts_[f].corners; }
  [[nodiscard]] const Vec3& vertex(VertexId v) const { return x_[v]; }

 private:
  struct Chart {
    Vec3 g1, g2;  // b1 = g1·(x − x0), b2 = g2·(x − x0)
    FaceVertices corners;
    std::array<FaceId, 3> neighbour;  // across the edge opposite to corner k
  };
  VertexField<Vec3> x_;
  FaceField<Chart> charts_;
};

}  // namespace meniscus
