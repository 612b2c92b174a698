#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

using FacetVertices = std::array<TetVertexId, 3>;

/// The corners of the facet opposite each corner of a cell, as `facet` has them.
inline constexpr std::array<std::array<std::size_t, 3>, 4> kFacetCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The facet of a cell opposite its corner k, its vertices counter-clockwise seen from outside the
/// cell (for a cell of positive volume).
[[nodiscard]] FacetVertices facet(const CellVertices& cell, std::size_t k);

/// Which cells lie on the two sides of every facet. Linear to build for cells of bounded number at
/// each vertex.
class FacetTable {
 public:
  explicit FacetTable(const TetMesh& mesh);

  /// The cell that has the facet v0 v1 v2 counter-clockwise seen from outside it; invalid if none.
  [[nodiscard]] CellId find(const FacetVertices& facet) const;
  /// The cell on the other side of the facet v0 v1 v2; invalid if none.
  [[nodiscard]] CellId find_across(const FacetVertices& facet) const {
    return find({facet[0], facet[2], facet[1]});
  }
  /// The cells across the facets opposite the four corners of a cell; invalid where there is none.
  [[nodiscard]] const std::array<CellId, 4>& neighbours(CellId c) const { return neighbours_[c]; }
  /// A cell that has a facet on the same side as another cell, so that the two overlap.
  [[nodiscard]] CellId overlapping() const { return overlapping_; }

 private:
  /// One side of a facet.
  struct Entry {
    std::uint64_t side = 0;  // what `side_of` gives
    CellId cell;
    std::uint8_t corner = 0;  // the facet lies opposite
  };
  void gather(const TetMesh& mesh);
  void pair_up(std::span<Entry> entries);

  std::vector<std::int32_t> first_;  // entries by their smallest vertex, rising by side
  std::vector<Entry> entries_;
  CellField<std::array<CellId, 4>> neighbours_;
  CellId overlapping_;
};

}  // namespace meniscus
