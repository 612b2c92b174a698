#pragma once
// Private header of the products of cells.

#include <vector>

#include "meniscus/flow/fem/cell_lanes.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// The cells of a problem by fours, and which they are, in the order of the lanes.
struct CellBatches {
  std::vector<lanes::StraightCells> straight;
  std::vector<lanes::CurvedCells> curved;
  std::vector<CellId> straight_cells, curved_cells;
};
[[nodiscard]] CellBatches cell_batches(const StokesProblem& problem);

}  // namespace meniscus::fem
