#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/mesh/carried_fields.hpp"
#include "meniscus/scene/region_sources.hpp"

namespace meniscus {

enum class EventKind { breakup, coalescence };

/// One change of topology, as events.csv has it (docs/notation.md).
struct TopologyEvent {
  EventKind kind = EventKind::breakup;
  Vec3 position = Vec3::Zero();  ///< middle of the neck that was cut or of the gap that was bridged
  std::vector<int> parents, children;              ///< ids of drops
  double volume_before = 0.0, volume_after = 0.0;  ///< all parents, all children [R0³]
  double area_before = 0.0, area_after = 0.0;      ///< [R0²]
  /// Σ tension · area [μ_out G R0³], bulk scalars left out.
  double energy_before = 0.0, energy_after = 0.0;
  std::optional<double> neck_radius, gap;  ///< [R0]; the one that the kind has
  /// Liquid that the cut or the bridge moved from one place to another before volumes were made to
  /// add up [R0³].
  double volume_moved = 0.0;
  FieldExcess field_excess = {};  ///< of the children's fields over the range of the parents'
  /// Which liquid the regions of the scene took, for what lives in them; no checkpoint holds it.
  RegionSources sources = {};
};

}  // namespace meniscus
