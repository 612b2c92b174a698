#pragma once

#include <vector>

#include "meniscus/topology/thread.hpp"

namespace meniscus {

struct FoundThreads {
  std::vector<Thread> threads;
  int num_tried = 0;  ///< places from which a thread was traced: what the search costs
};

/// The threads of the liquid on one side of a surface whose radius is somewhere below `widest`.
/// They are traced from the places where the liquid is thin, from the thinnest up. No thread found
/// so far is near these, and they are not next to a place without a thread. How many places are
/// tried depends on the shape, not on the number of vertices. On the outside all places are tried.
/// The result does not depend on how vertices are numbered.
[[nodiscard]] FoundThreads find_threads(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side,
                                        double widest);

}  // namespace meniscus
