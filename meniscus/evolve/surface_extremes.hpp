#pragma once

#include <optional>
#include <vector>

#include "meniscus/evolve/plane_section.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/rings.hpp"

namespace meniscus {

class SplinePatch;

/// Extreme points of a closed surface, on splines through its vertices (`SplinePatch`) around the
/// extreme vertex. Errors are some O(h⁵) on smooth surfaces; where splines are not to be trusted
/// the vertex's curvatures stand for the surface, O(h³). `mesh` must outlive this.
class SurfaceExtremes {
 public:
  /// `osculating` is the mesh's osculating curvature.
  SurfaceExtremes(const SurfaceMesh& mesh, SurfaceTopology topology,
                  const VertexField<VertexCurvature>& osculating);

  /// The maximum of e·x, e a unit vector [R0].
  [[nodiscard]] double support(const Vec3& e);
  /// Half of the extent along a unit vector [R0].
  [[nodiscard]] double half_extent(const Vec3& e) { return 0.5 * (support(e) + support(-e)); }
  /// Largest (sign = 1) or smallest (sign = −1) distance |P(x − c)|, P a projector.
  [[nodiscard]] ExtremeDistance extreme_distance(const Vec3& c, const Mat3& P, double sign);
  /// The same of |x − c| in the plane through c normal to e. `found` is near the extreme point.
  [[nodiscard]] ExtremeDistance extreme_in_plane(const Vec3& c, const Vec3& e, double sign,
                                                 const ExtremeDistance& found);

  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SurfaceTopology& topology() const { return topology_; }
  /// Normals and curvatures by `quartic_curvature`.
  [[nodiscard]] const VertexField<VertexCurvature>& fit() const { return fit_; }

 private:
  struct Around;
  [[nodiscard]] Around around(VertexId v);

  const SurfaceMesh& mesh_;
  SurfaceTopology topology_;
  VertexField<VertexCurvature> fit_;
  RingGatherer rings_;
};

}  // namespace meniscus
