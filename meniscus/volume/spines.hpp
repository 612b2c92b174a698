#pragma once

#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// How a point follows the surface that the ray through it leaves: with these parts of the motions
/// of the corners of the face there.
struct Spine {
  FaceVertices corners = {};
  Vec3 weights = Vec3::Zero();

  [[nodiscard]] Vec3 velocity(const VertexField<Vec3>& drop_motion) const {
    Vec3 motion = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      motion += weights[static_cast<Eigen::Index>(k)] * drop_motion[corners[k]];
    return motion;
  }
};

/// Rays from the centroid of a drop through its surface to the outer boundary (§4.4 of hooper2001).
/// Both surfaces must outlive it.
class Spines {
 public:
  Spines(const SurfaceMesh& drop, const SurfaceMesh& boundary);

  /// Whether each ray meets the drop's surface once and the boundary once: both are star-shaped
  /// about the drop's centroid (decided by exact predicates).
  [[nodiscard]] bool exist() const { return exist_; }

  /// The motion of the drop where the ray through x leaves it, times r/a inside and (b − r)/(b − a)
  /// outside. Distances from the centre are a of the drop there, r of x and b of the boundary. The
  /// factor is 1 at the drop, 0 at the centre and at the boundary. (The printed ratio, (r − a)/(b −
  /// a), is zero at the drop.)
  [[nodiscard]] Spine through(const Vec3& x) const;

 private:
  const SurfaceMesh& drop_;
  Vec3 center_;
  SurfaceTree drop_tree_, boundary_tree_;
  bool exist_;
};

}  // namespace meniscus
