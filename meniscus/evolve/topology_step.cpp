#include "meniscus/evolve/topology_step.hpp"

#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/carry_fields.hpp"

namespace meniscus {
namespace {

SurfaceMotion surface_motion(const Scene& scene, const InterfaceMotion& motion) {
  MENISCUS_ASSERT(motion.size() == scene.interfaces.size(), "{} motions of {} interfaces",
                  motion.size(), scene.interfaces.size());
  SurfaceMotion result;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    result.add(scene.interfaces[i].mesh, motion[i]);
  return result;
}

}  // namespace

TopologyReport change_topology(State& state, const TopologyOptions& options, const Scene& moved,
                               const InterfaceMotion& motion) {
  TopologyReport changed = apply_topology(state.scene, options, surface_motion(moved, motion));
  if (!changed.refusal.empty() || changed.events.empty()) return changed;
  widen(state.field_excess, changed.finishing_excess);
  for (const TopologyEvent& event : changed.events) widen(state.field_excess, event.field_excess);
  state.events = changed.events;
  state.volume_shift.assign(state.scene.interfaces.size(), 0.0);
  return changed;
}

std::string find_contact(const Scene& scene, const TopologyOptions& options, bool are_remeshed) {
  std::string contact = find_touching_drops(scene);
  if (contact.empty() && !are_remeshed) contact = find_folded_drop(scene);
  // With coalescence a shorter step lets drops come close first, without it they stay apart.
  if (!contact.empty() && !options.coalescence)
    contact += "; topology.coalescence = \"off\" keeps them apart";
  return contact;
}

}  // namespace meniscus
