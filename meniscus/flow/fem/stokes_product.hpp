#pragma once

#include <memory>
#include <span>

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

struct CellBatches;
class InertiaProduct;

/// What the viscous, pressure and continuity terms of quadratic elements on Newtonian liquids do to
/// a velocity and a pressure. It works cell by cell, without a matrix. A cell takes 150 bytes where
/// its share of a matrix takes 3,800 (docs/benchmark-stokes.md).
///
/// The gradient of a quadratic function is linear in barycentric coordinates, and so given by its
/// values at the four corners. From them the stress S follows at the corners of a straight cell, or
/// at the points of the curved rule. What it does to the test functions goes back the same way. On
/// straight cells ∫b_k b_l = V (1 + δ_kl)/20 makes all integrals exact.
///
/// Velocities and what is tested with them have three components side by side at each node;
/// pressures and what is tested with them are numbers. On several ranks what `add` and the like add
/// is right in the rows alone that a rank owns. Without inertia each takes the cells it owns, and
/// they are collective; with it each takes all cells around its rows.
class StokesProduct {
 public:
  /// Takes from the problem what it needs. Not for linear elements or other liquids.
  explicit StokesProduct(const StokesProblem& problem);
  StokesProduct(StokesProduct&&) noexcept;
  StokesProduct& operator=(StokesProduct&&) noexcept;
  ~StokesProduct();

  /// Sets the velocity that convects, in problems with inertia; nothing does before.
  void convect(std::span<const double> v);
  /// Adds what is linear in the problem once it is known what convects: `add_stress`, and with
  /// inertia ∫ρ(v/τ + a·∇v)·φ + τσ∮∇_sv:∇_sφ.
  void add(std::span<const double> v, std::span<const double> p, std::span<double> momentum,
           std::span<double> continuity) const;
  /// Adds ∫(2μ D(v) − p I):∇φ to `momentum`, and −∫ψ∇·v to `continuity`.
  void add_stress(std::span<const double> v, std::span<const double> p, std::span<double> momentum,
                  std::span<double> continuity) const;
  /// As `add_stress`. Cells where velocity and pressure are zero are passed over, for those that
  /// are zero in most.
  void add_stress_of_few(std::span<const double> v, std::span<const double> p,
                         std::span<double> momentum, std::span<double> continuity) const;
  /// Adds −∫p∇·φ to `momentum`, curved cells taken for straight ones between their corners. That is
  /// for preconditioners: iterations are as many, and a curved cell costs a tenth.
  void add_straight_gradient(std::span<const double> p, std::span<double> momentum) const;
  [[nodiscard]] const CellBatches& cells() const { return *cells_; }
  /// What inertia adds; null without.
  [[nodiscard]] const InertiaProduct* inertia() const { return inertia_.get(); }

 private:
  template <class Add>
  void add_by_ranks(std::span<double> momentum, std::span<double> continuity, const Add& add) const;

  std::unique_ptr<const CellBatches> cells_;
  const Partition* partition_ = nullptr;  // where ranks take their own cells; null elsewhere
  std::unique_ptr<InertiaProduct> inertia_;
};

/// Whether a problem has a product.
[[nodiscard]] inline bool has_product(const StokesProblem& problem) {
  return problem.space.elements == Elements::p2_p1 && !problem.is_generalised();
}

}  // namespace meniscus::fem
