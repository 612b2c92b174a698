#pragma once

#include "meniscus/surface/remesh_state.hpp"

namespace meniscus {

/// Moves the vertices along the reference surface toward the rest of a net of damped massless
/// springs (cristini2001),
///   dx_i/ds = (I − n n) · Σ_j (1 − s l0/|x_j − x_i|)(x_j − x_i),
/// one after another (Gauss–Seidel, somewhat over-relaxed): rest is all that counts, not the way
/// there. A vertex stays when it is within `spring_tolerance` l0 of where its springs would be at
/// rest; the net is at rest when all do. Only what state.unrelaxed names, and what moves with it,
/// is looked at; after `max_rounds` the rest of that waits for the next call. No move folds a face.
void relax_springs(RemeshState& state, double spring_tolerance, int max_rounds);

}  // namespace meniscus
