#pragma once

#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/partition.hpp"

namespace meniscus::fem {

/// The sparsities of the blocks A, B and C of a saddle system on one space.
class StokesSparsity {
 public:
  /// Columns are numbered as the space numbers its nodes, until `number_columns`.
  explicit StokesSparsity(const FlowSpace& space);

  /// Numbers the columns by the index maps, and makes the scalar patterns. To be called once.
  void number_columns(const Partition* partition);
  /// The graphs' positions take 600 bytes a node of linear elements. Where no cell is added by
  /// itself they are given back, and found again where one is.
  void forget_positions();
  void recall_positions(const FlowSpace& space);

  /// The graphs of nodes: entries of A are blocks of 3 × 3, of B blocks of 1 × 3, of C numbers.
  [[nodiscard]] const NodeGraph& velocity() const { return velocity_; }
  [[nodiscard]] const NodeGraph& coupling() const { return coupling_; }
  [[nodiscard]] const NodeGraph& pressure() const { return pressure_; }
  /// The scalar patterns; C's is its graph.
  // NOLINTBEGIN(readability-identifier-naming): blocks of the matrix, as in docs/notation.md
  [[nodiscard]] const ScalarPattern& A() const { return A_; }
  [[nodiscard]] const ScalarPattern& B() const { return B_; }
  // NOLINTEND(readability-identifier-naming)

 private:
  NodeGraph velocity_, coupling_, pressure_;
  ScalarPattern A_, B_;
};

}  // namespace meniscus::fem
