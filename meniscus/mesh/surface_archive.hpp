#pragma once

#include <string>

#include "meniscus/core/archive.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Puts a surface into an archive, bit for bit, as <path>/x and <path>/faces.
void save(const SurfaceMesh& mesh, Archive& archive, const std::string& path);

/// Throws InvalidInput when an entry is missing or damaged, or a face names a vertex beyond the
/// last.
[[nodiscard]] SurfaceMesh load_surface(const Archive& archive, const std::string& path);

}  // namespace meniscus
