#pragma once

#include <filesystem>

#include "meniscus/evolve/evolution.hpp"

namespace meniscus {

/// Throws InvalidInput when a field has the name of an array that frames always hold.
void check_field_names(const Evolution& evolution);

/// Writes all interfaces with curvature κ, normal velocity, velocity, vertex density, pressure jump
/// p_out − p_in (where the solver has a pressure), drop id and carried fields.
void write_surface_frame(const std::filesystem::path& path, const Evolution& evolution);
/// Writes the volume mesh with velocity, pressure (double valued on interfaces), region, cell
/// quality and carried fields.
void write_volume_frame(const std::filesystem::path& path, const Evolution& evolution);

}  // namespace meniscus
