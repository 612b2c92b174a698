#pragma once

#include <filesystem>

#include "meniscus/evolve/evolution.hpp"

namespace meniscus {

/// Throws InvalidInput naming a field with the name of an array that frames hold anyway.
void check_field_names(const Evolution& evolution);

/// All interfaces with curvature κ, normal velocity, velocity, vertex density, the jump of pressure
/// p_out − p_in (where the solver has a pressure), drop id and the fields that interfaces carry.
void write_surface_frame(const std::filesystem::path& path, const Evolution& evolution);
/// The volume mesh with velocity, pressure (double valued on interfaces), region, cell quality and
/// the fields that the mesh carries.
void write_volume_frame(const std::filesystem::path& path, const Evolution& evolution);

}  // namespace meniscus
