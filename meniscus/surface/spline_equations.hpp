#pragma once
// Private header of this room.

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "meniscus/surface/polynomial_fit.hpp"

namespace meniscus {

/// Interpolation in the plane by polyharmonic splines Σ c_i r_i⁷, r_i the distance from place i,
/// plus a polynomial p of degree four. A spline's value at x is Σ w_i times those at the places.
/// The weights solve
///
///   [Φ P; Pᵀ 0] [w; λ] = [φ(x); p(x)],   Φ_ij = |x_i − x_j|⁷,  φ_i = |x − x_i|⁷,
///
/// P having the 15 monomials at the places. They are found in the null space of Pᵀ (§6 of
/// benzi2005). Elimination with pivoting takes 15 places; their weights follow from those of the
/// others. On the null space Φ is positive definite, since r⁷ is conditionally so of order four.
/// Splines set up thousands of such systems in a step; this takes 0.6 of the time of eliminating
/// the whole matrix.
///
/// Where places do not determine the polynomial at x, or coincide, weights are large or not
/// numbers.
class SplineEquations {
 public:
  using Place = Eigen::Vector2d;
  static constexpr std::size_t kMost = 32;                     ///< places
  static constexpr std::size_t kLeast = 1 + num_monomials(4);  ///< places

  void set(std::span<const Place> places);
  /// Of each place, for the value at x.
  void weights(const Place& x, std::span<double> weights) const;

  /// A number for each place, in the order of elimination: the dependent ones first.
  struct alignas(64) Row {
    double at[kMost];
  };

 private:
  std::size_t count_ = 0;
  double scale_ = 1.0;                      // takes the places into the unit disc
  std::array<std::size_t, kMost> order_{};  // number of the place in each position
  Row u_, v_;
  std::array<Row, kLeast> eliminated_;  // P = L U: Uᵀ up to the diagonal, Lᵀ beyond
  std::array<Row, kLeast> dependence_;  // by how much a dependent weight falls with each other one
  std::array<Row, kMost> reduced_;      // Φ of dependent places; of others, Zᵀ Φ, with factors
};

}  // namespace meniscus
