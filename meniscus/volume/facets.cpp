#include "meniscus/volume/facets.hpp"

#include <algorithm>
#include <numeric>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// A facet with its smallest vertex first and its sense of rotation kept.
FacetVertices canonical_facet(const FacetVertices& f) {
  if (f[0] < f[1]) return f[0] < f[2] ? f : FacetVertices{f[2], f[0], f[1]};
  return f[1] < f[2] ? FacetVertices{f[1], f[2], f[0]} : FacetVertices{f[2], f[0], f[1]};
}

/// The other two vertices of a rotated facet, the smaller one first, and its sense as the last bit.
/// So the two sides of one facet differ in that bit alone.
std::uint64_t side_of(const FacetVertices& f) {
  const auto b = static_cast<std::uint64_t>(f[1].value), c = static_cast<std::uint64_t>(f[2].value);
  return b < c ? b << 32U | c << 1U : c << 32U | b << 1U | 1U;
}

}  // namespace

FacetVertices facet(const CellVertices& cell, std::size_t k) {
  MENISCUS_ASSERT(k < 4, "facet {}", k);
  return {cell[kFacetCorners[k][0]], cell[kFacetCorners[k][1]], cell[kFacetCorners[k][2]]};
}

FacetTable::FacetTable(const TetMesh& mesh)
    : first_(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0),
      entries_(4 * static_cast<std::size_t>(mesh.num_cells())),
      neighbours_(mesh.num_cells()) {
  gather(mesh);
  for (std::size_t v = 0; v + 1 < first_.size(); ++v)
    pair_up(std::span(entries_).subspan(static_cast<std::size_t>(first_[v]),
                                        static_cast<std::size_t>(first_[v + 1] - first_[v])));
}

/// Counting sort of all facets by their smallest vertex.
void FacetTable::gather(const TetMesh& mesh) {
  for (const CellVertices& cell : mesh.cells)
    for (const auto& [a, b, c] : kFacetCorners)
      ++first_[static_cast<std::size_t>(std::min({cell[a], cell[b], cell[c]}).value) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (const CellId c : mesh.cells.ids())
    for (std::uint8_t k = 0; k < 4; ++k) {
      const FacetVertices f = canonical_facet(facet(mesh.cells[c], k));
      std::int32_t& slot = next[static_cast<std::size_t>(f[0].value)];
      MENISCUS_ASSERT(slot < first_[static_cast<std::size_t>(f[0].value) + 1], "slot {}", slot);
      entries_[static_cast<std::size_t>(slot++)] = {side_of(f), c, k};
    }
}

/// Sorts those of one smallest vertex, so that the two sides of a facet follow each other.
void FacetTable::pair_up(std::span<Entry> entries) {
  std::ranges::sort(entries, {}, &Entry::side);
  for (std::size_t i = 0; i + 1 < entries.size(); ++i) {
    const Entry &a = entries[i], &b = entries[i + 1];
    if (a.side >> 1U != b.side >> 1U) continue;
    if (a.side == b.side) {
      overlapping_ = a.cell;
      continue;
    }
    neighbours_[a.cell][a.corner] = b.cell;
    neighbours_[b.cell][b.corner] = a.cell;
  }
}

CellId FacetTable::find(const FacetVertices& facet) const {
  const FacetVertices wanted = canonical_facet(facet);
  const auto v = static_cast<std::size_t>(wanted[0].value);
  MENISCUS_ASSERT(v + 1 < first_.size(), "vertex {}", wanted[0].value);
  const auto begin = entries_.begin() + first_[v], end = entries_.begin() + first_[v + 1];
  const std::uint64_t side = side_of(wanted);
  const auto entry = std::ranges::lower_bound(begin, end, side, {}, &Entry::side);
  if (entry != end && entry->side == side) return entry->cell;
  return {};
}

}  // namespace meniscus
