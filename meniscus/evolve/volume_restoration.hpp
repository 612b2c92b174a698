#pragma once

#include <limits>

#include "meniscus/evolve/constants.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/surface/edge_middles.hpp"

namespace meniscus {

/// Carries the fields of interface i along with its vertices, which stood at `before`.
void carry_fields(State& state, std::size_t i, const SurfaceMesh& before);

/// Gives interface i the volume that it is to have by shifting all its vertices by one length,
/// whose size `state` records. Fields follow.
void restore_volume(State& state, std::size_t i, SurfaceShape surface);

/// What becomes of an attempt at a step by the shift that restored its volumes.
enum class ShiftVerdict {
  accept,
  shorten,          ///< a shorter step is to be tried
  accept_for_good,  ///< it is too large, and no step's length will change that
};

/// Judges one attempt at a step after another.
class ShiftJudge {
 public:
  /// `state` stands at the end of the attempt; `can_shorten` says whether half its length may be
  /// tried. Steps with events are accepted: surgery shifts vertices, whatever the length.
  ShiftVerdict judge(const State& state, bool can_shorten);

 private:
  double before_ = std::numeric_limits<double>::infinity();  // of the attempt before
};

}  // namespace meniscus
