#pragma once

#include <filesystem>

#include "meniscus/evolve/evolution.hpp"

namespace meniscus {

/// All interfaces with curvature κ, normal velocity, velocity, vertex density, the jump of pressure
/// p_out − p_in (where the solver has a pressure) and drop id.
void write_surface_frame(const std::filesystem::path& path, const Evolution& evolution);
/// The volume mesh with velocity, pressure (double valued on interfaces), region and cell quality.
void write_volume_frame(const std::filesystem::path& path, const Evolution& evolution);

}  // namespace meniscus
