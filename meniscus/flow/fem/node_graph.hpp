#pragma once

#include <cstdint>
#include <vector>

#include "meniscus/flow/fem/spaces.hpp"

namespace meniscus::fem {

/// The sparsity of a bilinear form: which column nodes share a cell with each row node, in rising
/// order. It also holds where in that list each pair of a cell's local nodes belongs, so that
/// assembly never searches.
struct NodeGraph {
  std::int32_t num_columns = 0;
  std::vector<std::int32_t> row_start, columns;
  /// Which entry of its row local pair (a, b) of cell c is, at (c·rows_per_cell +
  /// a)·columns_per_cell
  /// + b.
  std::vector<std::uint16_t> position;

  [[nodiscard]] std::int32_t num_rows() const {
    return static_cast<std::int32_t>(row_start.size()) - 1;
  }
  [[nodiscard]] std::size_t num_entries() const { return columns.size(); }
  /// Index into `columns` of the local pair at `position[pair]`, whose row is given.
  [[nodiscard]] std::size_t entry(std::int32_t row, std::size_t pair) const {
    return static_cast<std::size_t>(row_start[static_cast<std::size_t>(row)]) + position[pair];
  }
};
/// Throws RunFailure where 32 bits do not number all pairs.
[[nodiscard]] NodeGraph node_graph(const NodeTable& rows, const NodeTable& columns);

/// The graph with every entry replaced by a dense block, as scalar compressed rows. The entry
/// (i, k) of the graph, k = its index in `columns`, has its block's row a starting at
/// row_start[rows·i + a] + block_columns·(k − graph.row_start[i]).
struct ScalarPattern {
  std::vector<std::int32_t> row_start, columns;
};
/// Throws RunFailure, before taking memory, where 32 bits do not number all entries.
[[nodiscard]] ScalarPattern scalar_pattern(const NodeGraph& graph, std::int32_t block_rows,
                                           std::int32_t block_columns);

}  // namespace meniscus::fem
