#pragma once
// Private header of what is made of batches of cells.

#include "meniscus/flow/fem/cell_batches.hpp"

namespace meniscus::fem {

/// ∫∇b_k·∇b_l and ∫b_k b_l of the barycentric coordinates of four cells.
struct alignas(64) LinearIntegrals {
  std::array<lanes::Corners, 4> gradients, values;
};

void set_linear_integrals(std::span<const lanes::StraightCells> cells, const Range& range,
                          LinearIntegrals* integrals);
void set_linear_integrals(std::span<const lanes::CurvedCells> cells, const Range& range,
                          LinearIntegrals* integrals);

/// Calls `use(cell, integrals, lane)` for every cell.
template <class Use>
void with_linear_integrals(const CellBatches& cells, Use use) {
  const auto all = [&](const auto& batches, const std::vector<CellId>& which) {
    const std::span of(batches);
    with_matrices<LinearIntegrals>(
        of.size(), which,
        [&](const Range& range, LinearIntegrals* to) { set_linear_integrals(of, range, to); }, use);
  };
  all(cells.straight, cells.straight_cells);
  all(cells.curved, cells.curved_cells);
}

}  // namespace meniscus::fem
