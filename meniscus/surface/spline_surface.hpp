#pragma once

#include <span>
#include <vector>

#include "meniscus/surface/rings.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// The surface through the vertices by splines, at single points. With z along the normal at the
/// smooth surface's point and H the half-sum of curvatures there, the function
///
///   g(u, v) = z + ½H (u² + v² + z²),
///
/// zero on the osculating sphere, is interpolated from the vertices in the two rings around by
/// polyharmonic splines Σ c_i |(u, v) − (u_i, v_i)|⁷ plus a polynomial of degree four. Exact on
/// spheres, else of an error of about O(h⁶). Where the rings do not determine the spline, it would
/// amplify the vertices' noise, or it swings far from the face, the smooth surface's point stands.
/// About 16 µs a point, where the patches of SmoothSurface take 2.
class SplineSurface {
 public:
  /// `smooth` is that of the mesh; all three must outlive this.
  SplineSurface(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                const SmoothSurface& smooth);

  /// The point over the middle of an edge.
  [[nodiscard]] Vec3 middle(const SurfaceEdge& edge);
  /// The point over one of a flat face.
  [[nodiscard]] Vec3 point(const SurfacePoint& location);

 private:
  /// A vertex around a point, by its weight there.
  struct Corner {
    VertexId vertex;
    double weight;
  };
  Vec3 lifted(const Vec3& smooth_point, std::span<const Corner> corners);
  void gather(std::span<const Corner> corners, const Vec3& center);

  const SurfaceMesh& mesh_;
  const SmoothSurface& smooth_;
  RingGatherer rings_;
  std::vector<Vec3> points_;  // of the rings around one point
};

}  // namespace meniscus
