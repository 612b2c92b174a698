#pragma once

#include <string>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/mesh/carried_fields.hpp"

namespace meniscus {

/// Puts fields into an archive under a path, bit for bit; nothing where there are none.
void save(const SurfaceFields& fields, Archive& archive, const std::string& path);
void save(const VolumeFields& fields, Archive& archive, const std::string& path);

/// Throws InvalidInput when an entry is missing or damaged, or a field does not fit the mesh.
[[nodiscard]] SurfaceFields load_fields(const Archive& archive, const std::string& path,
                                        const SurfaceMesh& mesh);
[[nodiscard]] VolumeFields load_fields(const Archive& archive, const std::string& path,
                                       const TetMesh& mesh);

}  // namespace meniscus
