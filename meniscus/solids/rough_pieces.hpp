#pragma once

#include <vector>

#include "meniscus/solids/target_search.hpp"

namespace meniscus {

/// Gives rough pieces even triangles; returns their length, 0 if no piece was rough.
double remesh_rough_pieces(std::vector<Piece>& pieces, const RemeshTarget& target);

/// Remeshes a surface with rough pieces, rounded, or cut evenly where that does not do: `given` are
/// the pieces as they came, `even` those in even triangles of `rough_edge`.
[[nodiscard]] Found search_rough(const std::vector<Piece>& given, const std::vector<Piece>& even,
                                 const RemeshTarget& target, double rough_edge);

}  // namespace meniscus
