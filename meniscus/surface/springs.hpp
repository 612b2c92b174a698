#pragma once

#include "meniscus/surface/remesh_state.hpp"

namespace meniscus {

/// Moves the vertices along the reference surface toward the rest of a net of damped massless
/// springs (cristini2001),
///   dx_i/ds = (I − n n) · Σ_j (1 − s l0/|x_j − x_i|)(x_j − x_i),
/// by explicit steps with momentum (heavy ball), until no step moves a vertex more than
/// `equilibrium` l0, or `max_steps`. Only what state.unrelaxed names, and what moves with it, is
/// looked at.
/// Steps that would fold a face are taken back at its corners. Returns the number of steps taken:
/// zero when the net is at rest already.
int relax_springs(RemeshState& state, double equilibrium, int max_steps);

}  // namespace meniscus
