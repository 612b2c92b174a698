#pragma once

#include "meniscus/flow/fem/laplacian_matrix.hpp"

namespace meniscus::fem {

/// The Jacobian of R(u) by its products: those of the cells for the unknowns that
/// `StokesJacobian` has. At constrained nodes these are in the constraint's frame, and fixed ones
/// have an equation of their own. On several ranks vectors hold the owned unknowns, and all
/// products are collective.
class FreeProduct {
 public:
  /// The problem must outlive this.
  FreeProduct(const StokesProblem& problem, const StokesProduct& product)
      : problem_(problem), product_(product) {}

  /// y = J x.
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// v = Bᵀ p.
  void multiply_gradient(std::span<const double> p, std::span<double> v) const;
  /// r = the Laplacians of the three components, that stand for A's diagonal blocks.
  void multiply_laplacians(const LaplacianMatrix& laplacian, std::span<const double> x,
                           std::span<double> r) const;
  /// Their diagonals at the owned nodes.
  [[nodiscard]] std::vector<double> diagonals_of(const LaplacianMatrix& laplacian) const;

 private:
  /// Turns a test's results into the frames, without the fixed components.
  void constrain(std::span<double> momentum) const;

  const StokesProblem& problem_;
  const StokesProduct& product_;
};

}  // namespace meniscus::fem
