#pragma once

#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// Rays from the centroid of a drop through its surface to the outer boundary (§4.4 of hooper2001).
/// Both surfaces must outlive it.
class Spines {
 public:
  Spines(const SurfaceMesh& drop, const SurfaceMesh& boundary);

  /// Whether each ray meets the drop's surface once and the boundary once: both are star-shaped
  /// about the drop's centroid (decided by exact predicates).
  [[nodiscard]] bool exist() const { return exist_; }

  /// `drop_motion`, interpolated where the ray through x leaves the drop at distance a from the
  /// centre, times r/a inside and (b − r)/(b − a) outside. r is the distance of x and b that of the
  /// boundary: whole at the drop, zero at the centre and at the boundary. (The printed ratio, (r −
  /// a)/(b − a), is zero at the drop.)
  [[nodiscard]] Vec3 velocity(const Vec3& x, const VertexField<Vec3>& drop_motion) const;

 private:
  const SurfaceMesh& drop_;
  Vec3 center_;
  SurfaceTree drop_tree_, boundary_tree_;
  bool exist_;
};

}  // namespace meniscus
