#pragma once

#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"
#include "meniscus/volume/size_law.hpp"
#include "meniscus/volume/tetgen_mesher.hpp"

namespace meniscus {

/// Those vertices between the surfaces of a mesh that a new mesh of nearly the same space may take
/// over. They are far enough from the new surfaces and from each other, in edges that `law`, the
/// new mesh's, wants there. The mesh may have no vertices.
/// Collective.
[[nodiscard]] std::vector<SizedVertex> vertices_to_keep(const TetMesh& mesh, const SizeLaw& law);

}  // namespace meniscus
