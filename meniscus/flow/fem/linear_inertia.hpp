#pragma once

#include <Eigen/Core>

#include "meniscus/flow/fem/cell_matrices.hpp"

namespace meniscus::fem {

/// What inertia (`InertiaTerms`) does to the velocity of one linear cell; its integrals are exact.
/// The matrices are the same for the three components.
class LinearInertia {
 public:
  /// Without convection where no velocity is given that convects.
  LinearInertia(const StokesProblem& problem, const LinearElement::Point& point, CellId c,
                const Field<NodeId, Vec3>* convecting);

  [[nodiscard]] double rate() const { return rate_; }  ///< ρ/T
  /// ∫ρφ_iφ_j/T.
  [[nodiscard]] const Eigen::Matrix4d& mass() const { return mass_; }
  /// ∫ρφ_i(φ_j/T + a·∇φ_j).
  [[nodiscard]] Eigen::Matrix4d momentum() const { return mass_ + convection_; }
  /// The mean of ρ(φ_j/T + a·∇φ_j) over the cell.
  [[nodiscard]] double mean(std::size_t j) const {
    return 0.25 * rate_ + mean_convection_[static_cast<Eigen::Index>(j)];
  }

  /// ∫ρ((v − v̄)/T + a·∇v) φ_i by columns, v being given by columns.
  [[nodiscard]] Eigen::Matrix<double, 3, 4> momentum_of(const Eigen::Matrix<double, 3, 4>& v) const;
  /// The mean of ρ((v − v̄)/T + a·∇v).
  [[nodiscard]] Vec3 mean_of(const Eigen::Matrix<double, 3, 4>& v) const;

 private:
  double rate_ = 0.0;
  Eigen::Matrix4d mass_, convection_ = Eigen::Matrix4d::Zero();
  Eigen::RowVector4d mean_convection_ = Eigen::RowVector4d::Zero();
  Eigen::Matrix<double, 3, 4> before_;
};

/// The element matrices of one linear cell with inertia. The lower left block has the part of
/// inertia in the stabilisation, −τ∫∇ψ·ρ(φ/T + a·∇φ). The Laplacian, which the velocity's
/// preconditioner is made of, has the mass too.
struct InertialMatrices : CellMatrices<LinearElement> {
  /// Without convection where no velocity is given that convects.
  InertialMatrices(const StokesProblem& problem, const LinearElement::Point& point, CellId c,
                   const Field<NodeId, Vec3>* convecting);

  [[nodiscard]] Mat3 viscous_block(std::size_t i, std::size_t j) const;
  [[nodiscard]] double laplacian(std::size_t i, std::size_t j) const;
  [[nodiscard]] Vec3 lower_left_of(std::size_t k, std::size_t j) const;
  /// ∫ρφ_i/T.
  [[nodiscard]] double lumped_mass() const { return inertia_.mass().col(0).sum(); }

 private:
  LinearInertia inertia_;
  Eigen::Matrix4d momentum_;
  Eigen::Matrix<double, 3, 4> slope_;  ///< τV∇ψ_k by columns
};

/// Gives a problem of linear elements with inertia its memory: θ∫∇·v̄ over each cell where its nodes
/// were. No region's volume changes. So the subscales of the velocity, which the stabilisation
/// stands for, have inertia of their own (badia2009). The equations then have a limit for short
/// stages. Without this the pressure would be stabilised by ever less.
void remember_divergence(StokesProblem& problem);

}  // namespace meniscus::fem
