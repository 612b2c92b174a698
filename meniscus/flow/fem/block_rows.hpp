#pragma once

#include <cstddef>
#include <span>

#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/flow/fem/node_graph.hpp"

namespace meniscus::fem {

/// The three rows of node i where a graph's entries are 3 × 3 blocks (see ScalarPattern).
class BlockRows {
 public:
  BlockRows(std::span<double> values, const NodeGraph& graph, std::int32_t i) {
    const std::int32_t start = graph.row_start[static_cast<std::size_t>(i)];
    width_ = 3 * static_cast<std::size_t>(graph.row_start[static_cast<std::size_t>(i) + 1] - start);
    first_ = values.data() + 9 * static_cast<std::size_t>(start);
  }
  /// At entry k of the row.
  void add(std::size_t k, const Mat3& block) const {
    double* row = first_ + 3 * k;
    for (Eigen::Index a = 0; a < 3; ++a, row += width_)
      for (Eigen::Index b = 0; b < 3; ++b) row[b] += block(a, b);
  }

 private:
  std::size_t width_ = 0;
  double* first_ = nullptr;
};

/// Puts a block into the frames of its row's and its column's constraint, null for free nodes. It
/// takes out rows and columns of fixed components, but for the diagonal.
inline void eliminate(Mat3& block, const NodeConstraint* row, const NodeConstraint* column,
                      bool is_diagonal) {
  if (row != nullptr && row->is_rotated()) block = row->frame.transpose() * block;
  if (column != nullptr && column->is_rotated()) block = block * column->frame;
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b) {
      const bool is_fixed = (row != nullptr && row->is_fixed[static_cast<std::size_t>(a)]) ||
                            (column != nullptr && column->is_fixed[static_cast<std::size_t>(b)]);
      if (is_fixed && !(is_diagonal && a == b)) block(a, b) = 0.0;
    }
}

/// The part of a row of B that multiplies the free components of one node.
[[nodiscard]] inline Vec3 free_divergence(const Vec3& divergence, const NodeConstraint* column) {
  if (column == nullptr) return divergence;
  Vec3 local = column->frame.transpose() * divergence;
  for (std::size_t b = 0; b < 3; ++b)
    if (column->is_fixed[b]) local[static_cast<Eigen::Index>(b)] = 0.0;
  return local;
}

}  // namespace meniscus::fem
