#pragma once

#include "meniscus/surface/remesh_state.hpp"

namespace meniscus {

struct KeptDensity;

/// Turns edges whose two opposite angles sum to more than 180° (Delaunay), as long as no face
/// folds; returns how many. Only edges around state.unflipped are looked at.
int flip_to_delaunay(RemeshState& state);

struct DensityEdits {
  int splits = 0, collapses = 0;
};
/// One pass of vertex addition and removal where the number of vertices is out of its band. Bands
/// are over some 12 vertices, or, when nearly all places are within, over 50, 200, or the whole.
/// Edits of one pass lie so many rings apart that each sees the density the others left.
DensityEdits balance_density(RemeshState& state);

/// Whether a surface may stay as it is. Its edges are within [0.6, 1.5] of their rest length, its
/// number of vertices within what is kept.
[[nodiscard]] bool has_fit_density(const RemeshState& state, const KeptDensity& kept);

/// ∮ρ dS over the smooth surface, ρ = 2/(√3 l0²) (eq. 2): the number of vertices it asks for.
[[nodiscard]] double expected_vertices(const RemeshState& state);

}  // namespace meniscus
