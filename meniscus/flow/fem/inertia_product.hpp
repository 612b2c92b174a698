#pragma once

#include <memory>
#include <span>
#include <vector>

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

struct CellBatches;
struct CellInertia;
struct ConvectedCells;

/// What inertia (`InertiaTerms`) does to a velocity, by cells of quadratic elements. Masses
/// are products of matrices, those of straight cells multiples of one. Convection, by a = v − w, is
/// summed over the points of a rule of degree 5, which is exact on straight cells. Velocities have
/// three components side by side at each node.
class InertiaProduct {
 public:
  /// The problem has inertia, and must outlive this, as must the batches of its cells.
  InertiaProduct(const StokesProblem& problem, const CellBatches& batches);
  ~InertiaProduct();

  /// Sets the velocity that convects; nothing does before.
  void convect(std::span<const double> v);
  [[nodiscard]] bool convects() const { return !convecting_.empty(); }
  /// ∫ρv/τ·φ by cells.
  [[nodiscard]] CellInertia by_cells() const;
  /// ∫ρ(v/τ + a·∇v)·φ by cells, once there is what convects.
  [[nodiscard]] ConvectedCells by_convected_cells() const;
  /// Adds ∫ρ(v/τ + a·∇v)·φ, without convection where nothing convects, and `add_tension`.
  void add(std::span<const double> v, std::span<double> momentum) const;
  /// Adds τσ∮∇_sv:∇_sφ + τ∮E ∇_s·v ∇_s·φ.
  void add_tension(std::span<const double> v, std::span<double> momentum) const;
  /// Adds ∫ρφ_iφ_i/τ.
  void add_mass_diagonal(std::span<double> by_node) const;
  /// Subtracts what is given: ∫ρv̄/τ·φ and `add_tension` of v*.
  void subtract_given(std::span<double> momentum) const;
  /// ∫ρ(v − v̄)/τ·v + ρ(a·∇v)·v: what the liquids' kinetic energy gains per time.
  [[nodiscard]] double kinetic_rate(std::span<const double> v, std::int32_t num_owned) const;

 private:
  void add_mass(std::span<const double> v, std::span<double> momentum) const;

  struct Cells;
  const InertiaTerms& terms_;
  const CellBatches& batches_;
  std::unique_ptr<Cells> cells_;
  std::vector<double> given_mass_, given_tension_;
  std::vector<double> convecting_;  ///< a, by nodes; empty where nothing convects
};

}  // namespace meniscus::fem
