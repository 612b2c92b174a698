#pragma once

#include <vector>

#include "meniscus/solids/target_search.hpp"

namespace meniscus {

/// Throws InvalidInput where a rough surface is a needle: its creases alone would take many times
/// the vertices that its area does. The target is in the units of the mesh.
void require_thickness(const SurfaceMesh& mesh, const RemeshTarget& target);

/// Gives rough pieces even triangles; returns their length, 0 if no piece was rough.
double remesh_rough_pieces(std::vector<Piece>& pieces, const RemeshTarget& target);

/// Remeshes a surface with rough pieces, rounded, or cut evenly where that does not do: `given` are
/// the pieces as they came, `even` those in even triangles of `rough_edge`.
[[nodiscard]] Found search_rough(const std::vector<Piece>& given, const std::vector<Piece>& even,
                                 const RemeshTarget& target, double rough_edge);

}  // namespace meniscus
