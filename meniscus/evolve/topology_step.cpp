#include "meniscus/evolve/topology_step.hpp"

#include <map>
#include <set>
#include <span>
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

/// The volume shifts after events: old drops keep theirs, new drops have zero.
std::vector<double> carried_shifts(const Scene& before, std::span<const double> shifts,
                                   const Scene& after) {
  MENISCUS_ASSERT(shifts.size() == before.interfaces.size(), "{} shifts of {} interfaces",
                  shifts.size(), before.interfaces.size());
  std::map<int, double> shift_of;
  for (std::size_t i = 0; i < before.interfaces.size(); ++i)
    shift_of[before.interfaces[i].drop] = shifts[i];
  std::vector<double> result;
  for (const Interface& interface : after.interfaces) {
    const auto known = shift_of.find(interface.drop);
    result.push_back(known == shift_of.end() ? 0.0 : known->second);
  }
  return result;
}

}  // namespace

std::vector<std::size_t> new_interfaces(const Scene& before, const Scene& after) {
  std::set<int> old;
  for (const Interface& interface : before.interfaces) old.insert(interface.drop);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < after.interfaces.size(); ++i)
    if (!old.contains(after.interfaces[i].drop)) result.push_back(i);
  return result;
}

TopologyReport change_topology(State& state, const TopologyOptions& options, const Scene& moved,
                               const InterfaceMotion& motion) {
  TopologyReport changed = apply_topology(state.scene, options, surface_motion(moved, motion));
  if (changed.refusal || changed.events.empty()) return changed;
  widen(state.field_excess, changed.finishing_excess);
  for (const TopologyEvent& event : changed.events) widen(state.field_excess, event.field_excess);
  state.events = changed.events;
  state.volume_shift = carried_shifts(moved, state.volume_shift, state.scene);
  return changed;
}

std::optional<Fault> find_contact(const Scene& scene, const TopologyOptions& options,
                                  bool are_remeshed) {
  std::optional<Fault> contact = find_touching_drops(scene);
  if (!contact && !are_remeshed) contact = find_folded_drop(scene);
  // With coalescence a shorter step brings drops close first; without it they must stay apart.
  if (contact && !options.coalescence)
    contact->text += "; topology.coalescence = \"off\" keeps them apart";
  return contact;
}

}  // namespace meniscus
