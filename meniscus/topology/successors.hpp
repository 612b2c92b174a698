#pragma once

#include <optional>
#include <span>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// The surfaces that are to replace some interfaces of a scene.
struct InterfaceReplacement {
  std::vector<std::size_t> parents;  ///< of the scene
  std::vector<SurfaceMesh> pieces;   ///< a cavity is turned inside out
  CarryingSurface refined = {};      ///< as in `Surgery`: what the pieces were made of
};

/// Replaces the parents by the pieces. Volumes are made to add up, drops get new ids (the least
/// never used), regions and nesting are found again. What the pieces enclose, less their cavities,
/// is what the parents enclosed (of a drop released from another, less it). What the surgery took
/// from that is given back to the pieces in equal parts. A cavity becomes an interface around the
/// liquid of the first parent's other side. Fields of the parents go to the pieces as their volumes
/// are restored (`replaced_fields`).
///
/// Interfaces that stay keep their order and come first; the event's drops, volumes, areas and
/// energies are filled in. Not done, with the reason, when a piece encloses nothing, is no sound
/// surface, or meets another interface or the outer boundary. The scene is then as before.
[[nodiscard]] std::optional<Fault> replace_interfaces(Scene& scene,
                                                      InterfaceReplacement replacement,
                                                      TopologyEvent& event);

}  // namespace meniscus
