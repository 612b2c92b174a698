#pragma once

#include <string>

#include "meniscus/core/archive.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// Positions and states in an archive, under names that begin with `prefix`, bit for bit. Loading
/// throws InvalidInput when arrays are missing or do not fit each other.
void save_positions(const NodePositions& positions, Archive& archive, const std::string& prefix);
[[nodiscard]] NodePositions load_positions(const Archive& archive, const std::string& prefix);

void save(const StokesState& state, Archive& archive, const std::string& prefix);
[[nodiscard]] StokesState load_state(const Archive& archive, const std::string& prefix);

}  // namespace meniscus::fem
