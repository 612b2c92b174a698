#pragma once
// Private header of the products of cells.

#include <algorithm>
#include <array>
#include <vector>

#include "meniscus/flow/fem/cell_lanes.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// The cells of a problem by fours, and which they are, in the order of the lanes. Those that this
/// rank owns come first, in batches of their own; a cell that is there again to fill one has no
/// volume then.
struct CellBatches {
  std::vector<lanes::StraightCells> straight;
  std::vector<lanes::CurvedCells> curved;
  std::vector<lanes::StraightCells> straightened;  ///< the curved ones, between their corners
  std::vector<CellId> straight_cells, curved_cells;
  std::size_t num_owned_straight = 0, num_owned_curved = 0;  ///< batches
};
[[nodiscard]] CellBatches cell_batches(const StokesProblem& problem);

/// Some of the batches.
struct Range {
  std::size_t begin, end;
};

/// Makes and uses the matrices of a few batches at a time, so that they stay in the cache. Calls
/// `set(range, matrices)`, then `use(cell, matrices, lane)` for each of these cells.
template <class Matrices, class Set, class Use>
void with_matrices(std::size_t num_batches, const std::vector<CellId>& cells, Set set, Use use) {
  constexpr std::size_t kAtOnce = 8;
  std::array<Matrices, kAtOnce> matrices;
  for (std::size_t begin = 0; begin < num_batches; begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, num_batches);
    set(Range{begin, end}, matrices.data());
    for (std::size_t n = lanes::kLanes * begin; n < std::min(lanes::kLanes * end, cells.size());
         ++n)
      use(cells[n], matrices[n / lanes::kLanes - begin], n % lanes::kLanes);
  }
}

}  // namespace meniscus::fem
