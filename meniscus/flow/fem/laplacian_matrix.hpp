#pragma once

#include <memory>
#include <span>
#include <vector>

#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/stokes_product.hpp"

namespace meniscus::fem {

/// ∫μ∇φ_i·∇φ_j of quadratic elements, with what is symmetric of inertia:
///   ∫ρφ_iφ_j/τ + τσ∮∇_sφ_i·∇_sφ_j, and of the elasticity the mean over the components.
/// One scalar matrix serves the three components of a velocity: it has a ninth of the entries that
/// they have together. Single precision will do, as it stands for them in preconditioners.
class LaplacianMatrix {
 public:
  /// The first `num_rows` nodes of the space have rows, every node has a column.
  LaplacianMatrix(const FlowSpace& space, std::int32_t num_rows);

  /// Fills the matrix for a problem on the space, and the product, which is the problem's. Linear
  /// cost.
  void assemble(const StokesProblem& problem, const StokesProduct& product);
  /// What it makes of a velocity that has three components side by side at each node, and one
  /// number more after all. `result` has three components for each row.
  void multiply(std::span<const double> v, std::span<double> result) const;
  [[nodiscard]] std::vector<double> diagonal() const;

 private:
  void add_cells(const StokesProblem& problem, const StokesProduct& product);
  void add_tension(const InertiaTerms& terms);
  [[nodiscard]] std::size_t entry(std::int32_t row, std::int32_t column) const;

  std::int32_t num_rows_;
  std::shared_ptr<const NodeGraph> graph_;
  std::vector<float> values_;
};

}  // namespace meniscus::fem
