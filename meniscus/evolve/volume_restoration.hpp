#pragma once

#include <limits>

#include "meniscus/evolve/constants.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/surface/edge_middles.hpp"

namespace meniscus {

/// Transfers the fields of interface i with its vertices, which moved from `before`.
void carry_fields(State& state, std::size_t i, const SurfaceMesh& before);

/// How an interface's volume was restored.
struct VolumeShift {
  double length = 0.0;            ///< [R0] largest shift of a vertex, along its normal
  double over_edge = 0.0;         ///< largest shift relative to the mean edge at the vertex
  FieldExcess field_excess = {};  ///< of conserved fields over the range they had
};
/// Restores the volume of an interface by shifting all vertices by one length. Fields are
/// transferred.
VolumeShift restore_volume(Interface& interface, SurfaceShape surface, KnownSurfaces& surfaces);
/// The volume of its flat faces.
VolumeShift restore_flat_volume(Interface& interface);
/// Records the restoration of the volume of interface i in the step under way.
void record(State& state, std::size_t i, const VolumeShift& shift);

/// The verdict on an attempt at a step, by the shift that restored its volumes.
enum class ShiftVerdict {
  accept,
  shorten,          ///< the step must be retried shorter
  accept_for_good,  ///< the shift is too large, but shorter steps do not reduce it
};

/// Judges the attempts at one step in turn.
class ShiftJudge {
 public:
  /// `state` stands at the end of the attempt; `can_shorten` says whether half its length may be
  /// tried. Steps with events are accepted: surgery shifts vertices, whatever the length.
  ShiftVerdict judge(const State& state, bool can_shorten);

 private:
  double before_ = std::numeric_limits<double>::infinity();  // shift of the previous attempt
};

}  // namespace meniscus
