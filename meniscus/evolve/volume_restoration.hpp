#pragma once

#include "meniscus/evolve/state.hpp"
#include "meniscus/surface/edge_middles.hpp"

namespace meniscus {

/// Carries the fields of interface i along with its vertices, which stood at `before`.
void carry_fields(State& state, std::size_t i, const SurfaceMesh& before);

/// Gives interface i the volume that it is to have by shifting all its vertices by one length,
/// whose size `state` records. Fields follow.
void restore_volume(State& state, std::size_t i, SurfaceShape surface);

}  // namespace meniscus
