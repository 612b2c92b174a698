#pragma once

#include <vector>

#include "meniscus/solids/target_search.hpp"

namespace meniscus {

/// Throws InvalidInput where a creased surface is a needle: its creases alone would take many times
/// the vertices that its area does. The target is in the units of the mesh.
void require_thickness(const SurfaceMesh& mesh, const RemeshTarget& target);

/// Remeshes a surface with rough pieces: in even triangles that are rounded, or cut evenly where
/// that does not do.
[[nodiscard]] Found search_rough(const std::vector<Piece>& given, const RemeshTarget& target);

}  // namespace meniscus
