#pragma once

#include <numbers>

#include "meniscus/flow/fem/cell_matrices.hpp"
#include "meniscus/flow/fem/cell_state.hpp"

namespace meniscus::fem {

/// About which state a generalised-Newtonian problem is linearised, and how.
struct Linearization {
  enum class Kind {
    picard,  ///< the viscosity as the state has it, held fixed
    newton   ///< with its derivative: exact
  };
  const StokesState& state;
  Kind kind = Kind::newton;
};

/// The element matrices of one cell of a generalised-Newtonian liquid. With s = d ln μ/d ln γ̇ and
/// E = D/|D|, in the Frobenius norm, the derivative of 2μ D:D(φ) in the direction φ' is
///   2μ (D(φ'):D(φ) + s E:D(φ') E:D(φ)),
/// symmetric, and positive definite where s > −1. The stabilisation's τ ~ 1/μ adds
///   τ s ∫∇ψ·(∇p − f) E:D(φ')/|D|
/// to the continuity rows, which makes the whole nonsymmetric for P1. Laplacian and pressure mass,
/// which the preconditioners are made of, have the state's viscosity and no derivative.
template <class Element>
struct TangentMatrices : CellMatrices<Element> {
  using Base = CellMatrices<Element>;
  using Point = typename Element::Point;
  using Base::kRows;
  /// Σ w 2μ s (E∇φ_i)_a (E∇φ_j)_b in block (i, j) at (a, b).
  Eigen::Matrix<double, kRows, kRows> rank_one;
  Eigen::Matrix<double, 4, kRows> lower_left;

  TangentMatrices(const StokesProblem& problem, std::span<const Point> points, CellId c,
                  const Linearization& about);

  [[nodiscard]] Mat3 viscous_block(std::size_t i, std::size_t j) const {
    return Base::viscous_block(i, j) +
           rank_one.template block<3, 3>(static_cast<Eigen::Index>(3 * i),
                                         static_cast<Eigen::Index>(3 * j));
  }
  [[nodiscard]] Vec3 lower_left_of(std::size_t k, std::size_t j) const {
    return lower_left.template block<1, 3>(static_cast<Eigen::Index>(k),
                                           static_cast<Eigen::Index>(3 * j));
  }

 private:
  /// What the viscosity's derivative adds at a point of rate of strain D.
  void add_derivative(const StokesProblem& problem, const CellState<Element>& cell,
                      const Point& point, CellId c, const Mat3& D, const RelativeViscosity& at);
};

template <class Element>
TangentMatrices<Element>::TangentMatrices(const StokesProblem& problem,
                                          std::span<const Point> points, CellId c,
                                          const Linearization& about) {
  rank_one.setZero();
  lower_left.setZero();
  const CellState<Element> cell(problem.space, about.state, c);
  for (const Point& point : points) {
    const Mat3 D = rate_of_strain(cell.velocity_gradient(point));
    const RelativeViscosity at =
        relative_viscosity(*problem.law(c), std::numbers::sqrt2 * D.norm());
    this->add(problem, point, c, problem.viscosity[c] * at.value);
    if (about.kind == Linearization::Kind::newton && at.slope != 0.0)
      add_derivative(problem, cell, point, c, D, at);
  }
  lower_left += this->divergence;
}

template <class Element>
void TangentMatrices<Element>::add_derivative(const StokesProblem& problem,
                                              const CellState<Element>& cell, const Point& point,
                                              CellId c, const Mat3& D,
                                              const RelativeViscosity& at) {
  const double size = D.norm(), viscosity = problem.viscosity[c] * at.value;
  if (size == 0.0) return;  // a slope without a direction: its limit is zero
  // E∇φ_i by columns, then one below the other.
  const Eigen::Matrix<double, 3, Element::num_nodes> columns = (D / size) * point.gradient;
  const Eigen::Map<const Eigen::Matrix<double, kRows, 1>> rates(columns.data());
  rank_one.noalias() += (point.weight * 2.0 * viscosity * at.slope * rates) * rates.transpose();
  if constexpr (Element::is_stabilized) {
    const double tau = stabilisation_parameter(problem, c, point.weight, viscosity);
    const Vec3 excess = point.gradient * cell.p - problem.body_force[c];
    lower_left.noalias() += (point.weight * tau * at.slope / size) *
                            (point.gradient.transpose() * excess) * rates.transpose();
  }
}

}  // namespace meniscus::fem
