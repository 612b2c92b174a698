#pragma once

#include <vector>

#include "meniscus/topology/section.hpp"

namespace meniscus {

/// Which side of an interface a thread or a film lies on.
enum class Side { inside, outside };
/// +1 for `outside`: n points into the liquid there.
[[nodiscard]] constexpr double sign_of(Side side) { return side == Side::outside ? 1.0 : -1.0; }

/// What lies beyond an end of a traced thread.
enum class ThreadEnd {
  wide,  ///< it widens into a body
  tip,   ///< it ends
  ring   ///< it meets its own other end
};

/// A thin part of the liquid on one side of a surface. It has sections across, in order along it,
/// about a quarter of a radius apart.
struct Thread {
  std::vector<Section> sections;
  ThreadEnd front = ThreadEnd::tip, back = ThreadEnd::tip;
};

/// Follows the thread through `within`, a point in it, both ways, while its radius is below
/// `widest`. Each section is normal to the line through the centroids of the last two. No sections
/// when there is no thread there.
[[nodiscard]] Thread thread_through(const SurfaceMesh& mesh, const SurfaceTree& tree,
                                    const Vec3& within, Side side, double widest);

}  // namespace meniscus
