#pragma once

#include "meniscus/surface/remesh_state.hpp"

namespace meniscus {

/// Turns edges whose two opposite angles sum to more than 180° (Delaunay), as long as no face
/// folds; returns how many.
int flip_to_delaunay(RemeshState& state);

struct DensityEdits {
  int splits = 0, collapses = 0;
};
/// One pass of vertex addition and removal where the local number of vertices is out of its band,
/// or, when all places are within, where the whole number is. Edits of one pass lie at least a ring
/// apart, so that each sees the density the others left.
DensityEdits balance_density(RemeshState& state);

/// ∮ρ dS over the smooth surface, ρ = 2/(√3 l0²) (eq. 2): the number of vertices it asks for.
[[nodiscard]] double expected_vertices(const RemeshState& state);

}  // namespace meniscus
