#pragma once

#include <optional>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/state.hpp"

namespace meniscus {

/// Carries out the cuts and bridges that are due in the remeshed interfaces of a state. `moved` is
/// the scene before remeshing and `motion` the velocity that led there. The events are stored in
/// the state. The caller must remesh the `new_interfaces`.
TopologyReport change_topology(State& state, const TopologyOptions& options, const Scene& moved,
                               const InterfaceMotion& motion);

/// The indices of interfaces that an earlier scene does not have, which events made.
[[nodiscard]] std::vector<std::size_t> new_interfaces(const Scene& before, const Scene& after);

/// A fault if two interfaces touch or one touches itself. A surface that was remeshed is known not
/// to touch itself.
[[nodiscard]] std::optional<Fault> find_contact(const Scene& scene, const TopologyOptions& options,
                                                bool are_remeshed);

}  // namespace meniscus
