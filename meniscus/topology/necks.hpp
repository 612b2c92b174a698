#pragma once

#include <vector>

#include "meniscus/topology/section.hpp"
#include "meniscus/topology/surface_motion.hpp"
#include "meniscus/topology/thread.hpp"

namespace meniscus {

/// The thinnest section of a thread, where it is cut.
struct Neck {
  Vec3 center = Vec3::Zero();
  Vec3 axis = Vec3::UnitX();
  double radius = 0.0;  ///< perimeter of the section/2π [R0]
  double area = 0.0;    ///< of the section [R0²]
  double rate = 0.0;    ///< mean of v·e over it, e away from the centre: < 0 thins [G R0]
  std::vector<FaceId> faces = {};  ///< the ring of faces that the section crosses
};

/// All places of a closed surface where a thread of the liquid on one side of it is locally
/// thinnest, thinner than `radius` and thinning. They are in rising order of their radius. A place
/// is locally thinnest when the thread widens by a tenth on either side of it before it becomes any
/// thinner. So neither a pointed end nor the roughness of a triangulation is one. A thread of the
/// liquid outside is the hole of a torus. Necks closer than four radii count as one. What they are
/// depends on the surface alone, not on the numbering of its vertices. A place that is tried costs
/// O(|F|); `find_threads` says how many are tried.
[[nodiscard]] std::vector<Neck> find_necks(const SurfaceMesh& mesh, const SurfaceTree& tree,
                                           Side side, double radius, const SurfaceMotion& motion);

}  // namespace meniscus
