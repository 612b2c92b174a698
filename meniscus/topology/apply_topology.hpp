#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/events.hpp"
#include "meniscus/topology/surface_motion.hpp"

namespace meniscus {

struct TopologyOptions {
  double breakup_radius = 0.0;   ///< [R0] a thinning neck below it is cut; 0: never
  bool coalescence = false;      ///< whether drops that come close merge
  double coalescence_gap = 0.0;  ///< [R0] the gap below which they do; 0: never
  double edge_floor = 0.0;       ///< [R0] no interface edge is asked to be shorter

  [[nodiscard]] bool is_off() const {
    return breakup_radius == 0.0 && !(coalescence && coalescence_gap > 0.0);
  }
};

struct [[nodiscard]] TopologyReport {
  std::vector<TopologyEvent> events;  ///< in the order in which they were carried out
  std::vector<std::string> warnings;  ///< places due whose surgery failed: left as they were
  /// Why an event that is due must not happen (`unlike_liquids`); the scene is then as given.
  std::optional<Fault> refusal;
  /// By how much the remeshing of the children at the end took fields over their range. The events
  /// hold what the cuts and bridges did.
  FieldExcess finishing_excess = {};
};

/// Cuts every neck that is due, the thinnest first, then opens every film that is due, the thinnest
/// first. Places closer than a few radii to one that was dealt with wait for the next call.
/// `motion` is that of the surfaces of the scene, or unknown: then every neck thins and every gap
/// closes.
///
/// - a thread of a drop thinner than `breakup_radius` is cut (breakup);
/// - a film thinner than `coalescence_gap`, between two interfaces or two parts of one, is opened
///   (coalescence). So is the thread of outer liquid in the hole of a drop, when narrower than that
///   gap.
///
/// Each event is all or nothing: what fails is left as it was, with a warning.
TopologyReport apply_topology(Scene& scene, const TopologyOptions& options,
                              const SurfaceMotion& motion);

/// The first two drops whose surfaces touch, with the place; none when no two do.
[[nodiscard]] std::optional<Fault> find_touching_drops(const Scene& scene);
/// The first drop whose surface meets itself, with the place; none when no surface does.
[[nodiscard]] std::optional<Fault> find_folded_drop(const Scene& scene);

}  // namespace meniscus
