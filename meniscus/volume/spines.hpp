#pragma once

#include <array>
#include <optional>

#include "meniscus/geometry/triangle.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

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

/// A closed surface as seen from a centre about which it is star-shaped: each ray meets it once.
/// The face on a ray is found by walking across edges from the face of the ray before. For the
/// vertices of a mesh that takes a quarter of the time of a tree. The mesh must outlive it.
class StarSurface {
 public:
  StarSurface(const SurfaceMesh& mesh, const Vec3& center);

  /// Whether every face shows its inner side to the centre (decided by exact predicates). What
  /// follows needs that.
  [[nodiscard]] bool is_star_shaped() const { return is_star_shaped_; }

  struct Hit {
    FaceVertices corners;
    Vec3 weights;     ///< of the corners
    double distance;  ///< from the centre
  };
  /// Where the ray along a unit vector leaves the surface.
  [[nodiscard]] std::optional<Hit> hit(const Vec3& direction) const;

 private:
  /// A face and what its edges, from corner k to k + 1, have on the other side. A direction is
  /// within the face's cone where it is on the inner side of all three planes.
  struct Cone {
    std::array<Vec3, 3> normals;  // of the planes through the centre and an edge
    std::array<FaceId, 3> across;
  };
  [[nodiscard]] FaceId face_on_ray(const Vec3& direction) const;

  const SurfaceMesh& mesh_;
  Vec3 center_;
  bool is_star_shaped_;
  FaceField<Cone> cones_;
  mutable FaceId last_{0};  // where the walk before ended
};

/// Rays from the centroid of a drop through its surface to the outer boundary (§4.4 of hooper2001).
/// Both surfaces must outlive it.
class Spines {
 public:
  Spines(const SurfaceMesh& drop, const SurfaceMesh& boundary);

  /// Whether each ray meets the drop's surface once and the boundary once: both are star-shaped
  /// about the drop's centroid (decided by exact predicates).
  [[nodiscard]] bool exist() const { return drop_.is_star_shaped() && boundary_.is_star_shaped(); }

  /// The motion of the drop where the ray through x leaves it, times r/a inside and (b − r)/(b − a)
  /// outside. Distances from the centre are a of the drop there, r of x and b of the boundary. The
  /// factor is 1 at the drop, 0 at the centre and at the boundary. (The printed ratio, (r − a)/(b −
  /// a), is zero at the drop.)
  [[nodiscard]] Spine through(const Vec3& x) const;

 private:
  Vec3 center_;
  StarSurface drop_, boundary_;
};

}  // namespace meniscus
