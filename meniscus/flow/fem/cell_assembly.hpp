#pragma once

#include <array>
#include <vector>

#include "meniscus/flow/fem/block_rows.hpp"
#include "meniscus/flow/fem/scalar_laplacians.hpp"
#include "meniscus/flow/fem/stokes_sparsity.hpp"

namespace meniscus::fem {

/// The values of a saddle system's blocks, on the sparsities of `StokesSparsity`.
struct StokesValues {
  std::vector<double> A, B, C;
  std::vector<double> lower_left;  ///< on B's pattern; empty where it is B
  std::vector<double> pressure_mass;
  std::vector<double> consistent_mass;  ///< on C's pattern; of P2-P1 alone
};

/// Adds the matrices of cells to a system's, constraints eliminated.
class CellAssembly {
 public:
  /// All that is given must outlive this.
  CellAssembly(const FlowSpace& space, const StokesSparsity& sparsity,
               const Constraints& constraints, StokesValues& values,
               std::span<ScalarLaplacian> laplacians)
      : space_(space),
        sparsity_(sparsity),
        constraints_(constraints),
        values_(values),
        laplacians_(laplacians) {}

  /// `Matrices` are `CellMatrices` or what extends them.
  template <class Matrices>
  void add(const Matrices& matrices, CellId c) {
    if (is_free(c))
      add_free(matrices, c);
    else
      add_constrained(matrices, c);
    if (!values_.lower_left.empty()) add_lower_left(matrices, c);
    add_pressure_blocks(matrices, c);
  }

 private:
  /// Whether no node of a cell is constrained.
  [[nodiscard]] bool is_free(CellId c) const;
  template <class Matrices>
  void add_free(const Matrices& matrices, CellId c);
  template <class Matrices>
  void add_constrained(const Matrices& matrices, CellId c);
  template <class Matrices>
  void add_lower_left(const Matrices& matrices, CellId c);
  template <class Matrices>
  void add_pressure_blocks(const Matrices& matrices, CellId c);
  /// The entry that joins pressure k and velocity j of a cell, in B or a matrix of its pattern.
  [[nodiscard]] Eigen::Map<Vec3> coupling(std::vector<double>& values, CellId c, std::size_t k,
                                          std::size_t j) const;
  [[nodiscard]] static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

  const FlowSpace& space_;
  const StokesSparsity& sparsity_;
  const Constraints& constraints_;
  StokesValues& values_;
  std::span<ScalarLaplacian> laplacians_;
};

inline bool CellAssembly::is_free(CellId c) const {
  return std::ranges::none_of(space_.velocity.of(c), [&](std::int32_t i) {
    return constraints_.find(NodeId{i}) != nullptr;
  });
}

inline Eigen::Map<Vec3> CellAssembly::coupling(std::vector<double>& values, CellId c, std::size_t k,
                                               std::size_t j) const {
  const auto n = at(space_.velocity.nodes_per_cell);
  return Eigen::Map<Vec3>(values.data() +
                          3 * sparsity_.coupling().entry(space_.pressure.nodes.of(c)[k],
                                                         n * (4 * at(c.value) + k) + j));
}

template <class Matrices>
void CellAssembly::add_free(const Matrices& matrices, CellId c) {
  constexpr std::size_t n = Matrices::num_nodes;
  const NodeGraph& graph = sparsity_.velocity();
  const auto nodes = space_.velocity.of(c);
  const std::size_t first = n * n * at(c.value);
  for (std::size_t i = 0; i < n; ++i) {
    const BlockRows rows(values_.A, graph, nodes[i]);
    for (std::size_t j = 0; j < n; ++j)
      rows.add(graph.position[first + n * i + j], matrices.viscous_block(i, j));
  }
  for (ScalarLaplacian& laplacian : laplacians_)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        laplacian.values[graph.entry(nodes[i], first + n * i + j)] += matrices.laplacian(i, j);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < n; ++j)
      coupling(values_.B, c, k, j) += matrices.divergence_of(k, j);
}

template <class Matrices>
void CellAssembly::add_constrained(const Matrices& matrices, CellId c) {
  constexpr std::size_t n = Matrices::num_nodes;
  const NodeGraph& graph = sparsity_.velocity();
  const auto nodes = space_.velocity.of(c);
  const std::size_t first = n * n * at(c.value);
  std::array<const NodeConstraint*, n> constraints{};
  for (std::size_t i = 0; i < n; ++i) constraints[i] = constraints_.find(NodeId{nodes[i]});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t pair = first + n * i + j;
      Mat3 block = matrices.viscous_block(i, j);
      eliminate(block, constraints[i], constraints[j], i == j);
      BlockRows(values_.A, graph, nodes[i]).add(graph.position[pair], block);
      for (ScalarLaplacian& laplacian : laplacians_) {
        const bool is_fixed = laplacian.is_fixed[at(nodes[i])] || laplacian.is_fixed[at(nodes[j])];
        if (!is_fixed || i == j)
          laplacian.values[graph.entry(nodes[i], pair)] += matrices.laplacian(i, j);
      }
    }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < n; ++j)
      coupling(values_.B, c, k, j) += free_divergence(matrices.divergence_of(k, j), constraints[j]);
}

template <class Matrices>
void CellAssembly::add_lower_left(const Matrices& matrices, CellId c) {
  const auto nodes = space_.velocity.of(c);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < Matrices::num_nodes; ++j)
      coupling(values_.lower_left, c, k, j) +=
          free_divergence(matrices.lower_left_of(k, j), constraints_.find(NodeId{nodes[j]}));
}

template <class Matrices>
void CellAssembly::add_pressure_blocks(const Matrices& matrices, CellId c) {
  const auto nodes = space_.pressure.nodes.of(c);
  for (std::size_t i = 0; i < 4; ++i) {
    values_.pressure_mass[at(nodes[i])] += matrices.pressure_mass(i);
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t k = sparsity_.pressure().entry(nodes[i], 16 * at(c.value) + 4 * i + j);
      values_.C[k] += matrices.stabilisation(i, j);
      if (!values_.consistent_mass.empty())
        values_.consistent_mass[k] += matrices.consistent_mass(i, j);
    }
  }
}

}  // namespace meniscus::fem
