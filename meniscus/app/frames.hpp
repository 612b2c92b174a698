#pragma once

#include <filesystem>

#include "meniscus/evolve/evolution.hpp"

namespace meniscus {

/// Throws InvalidInput when a bulk scalar or a field has the name of an array that frames always
/// hold, or a field that of a scalar.
void check_field_names(const Evolution& evolution);

/// Writes all interfaces with curvature κ, normal velocity, velocity, vertex density, pressure jump
/// p_out − p_in (where the solver has a pressure), drop id, carried fields and bulk scalars.
void write_surface_frame(const std::filesystem::path& path, const Evolution& evolution);
/// Writes the volume mesh with velocity, pressure and concentrations of species (double valued on
/// interfaces), region, cell quality, carried fields and temperatures.
void write_volume_frame(const std::filesystem::path& path, const Evolution& evolution);

}  // namespace meniscus
