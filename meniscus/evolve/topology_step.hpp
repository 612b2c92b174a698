#pragma once

#include <optional>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/state.hpp"

namespace meniscus {

/// Cuts and bridges what is due in the interfaces of a state as remeshed; `moved`, the scene before
/// that, with `motion` says how they came there. The state takes the events. The `new_interfaces`
/// are then still to be remeshed.
TopologyReport change_topology(State& state, const TopologyOptions& options, const Scene& moved,
                               const InterfaceMotion& motion);

/// The interfaces of a scene that an earlier scene does not have: what events have made.
[[nodiscard]] std::vector<std::size_t> new_interfaces(const Scene& before, const Scene& after);

/// Why the interfaces may not stand as they do: two touch, or one touches itself; none when none
/// does. A surface that could be remeshed is known not to touch itself.
[[nodiscard]] std::optional<Fault> find_contact(const Scene& scene, const TopologyOptions& options,
                                                bool are_remeshed);

}  // namespace meniscus
