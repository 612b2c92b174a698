#pragma once

#include <vector>

#include "meniscus/volume/linear_reconstruction.hpp"

namespace meniscus {

/// Cells across the facets of each cell, within its group; invalid where there is none.
using GroupNeighbours = CellField<std::array<CellId, 4>>;
[[nodiscard]] GroupNeighbours group_neighbours(const TetMesh& mesh,
                                               const CellField<std::int32_t>& group);

/// A conserved field on a new mesh that still owes something to its amounts.
struct IndebtedField {
  CellField<double> value;
  CellField<double> debt;       ///< amount that a cell must still take up, of either sign
  CellField<ValueRange> range;  ///< the values that a cell may take
};

/// Spreads the debts over neighbouring cells and pays as much of them as the cells' ranges allow.
/// Σ (value |c| + debt) stays to round-off.
void settle_debts(IndebtedField& field, const CellField<double>& volume,
                  const GroupNeighbours& neighbours);

/// Brings Σ value |c| over some cells to an amount. First value += θ (high − value), or the same
/// towards `low`, with one θ for all. What exceeds θ = 1 is of the same density everywhere.
void settle_amount(CellField<double>& value, const CellField<double>& volume,
                   const std::vector<CellId>& cells, const ValueRange& range, double amount);

/// Σ value |c| over some cells, compensated.
[[nodiscard]] double amount_of(const CellField<double>& value, const CellField<double>& volume,
                               const std::vector<CellId>& cells);

}  // namespace meniscus
