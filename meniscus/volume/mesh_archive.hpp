#pragma once

#include <string>

#include "meniscus/core/archive.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// A tetrahedral mesh under names that begin with `prefix`, bit for bit.
void save(const TetMesh& mesh, Archive& archive, const std::string& prefix);
/// Throws InvalidInput when arrays are missing or do not fit each other.
[[nodiscard]] TetMesh load_mesh(const Archive& archive, const std::string& prefix);

}  // namespace meniscus
