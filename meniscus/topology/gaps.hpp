#pragma once

#include <vector>

#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/surface_motion.hpp"
#include "meniscus/topology/thread.hpp"

namespace meniscus {

/// The closest place of a film: where two interfaces, or two parts of one, face each other.
struct Gap {
  std::size_t a = 0, b = 0;   ///< interfaces of the scene; the same: two parts of one
  Side side = Side::outside;  ///< on which side of a the film lies
  double width = 0.0;         ///< [R0]
  Vec3 from = Vec3::Zero();   ///< on a
  Vec3 to = Vec3::Zero();     ///< on b
  /// Points of either surface across from which the film is thinner than the limit.
  std::vector<Vec3> patch = {};

  [[nodiscard]] Vec3 middle() const { return 0.5 * (from + to); }
};

/// Distances of facing surfaces below `limit`, in rising order, whose surfaces approach each other:
///   v(from)·m(from) + v(to)·m(to) > 0,  m the normal into the film.
/// Facing: the normals into the film are opposed to within 60°, and the line between the points is
/// within 60° of both. Two parts of one surface count as facing only if no path on it shorter than
/// the ball of 3 `limit` around the middle joins them: neither the rim of a film nor a neck is a
/// gap. Of the places of one film that the limit joins, only the closest is given.
[[nodiscard]] std::vector<Gap> find_gaps(const Scene& scene, double limit,
                                         const SurfaceMotion& motion);

/// The width of the film beyond a vertex of a closed surface whose two sides face each other across
/// it; infinite where it is no film thinner than `limit`.
[[nodiscard]] double film_width(const SurfaceMesh& mesh, const SurfaceTree& tree, const Vec3& x,
                                const Vec3& into_film, double limit);

}  // namespace meniscus
