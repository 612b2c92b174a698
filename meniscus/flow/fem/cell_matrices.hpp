#pragma once

#include <array>

#include <Eigen/Core>

#include "meniscus/flow/fem/cell_state.hpp"

namespace meniscus::fem {

/// The element matrices of one cell.
template <class Element>
struct CellMatrices {
  static constexpr std::size_t num_nodes = Element::num_nodes;
  static constexpr int kRows = 3 * static_cast<int>(num_nodes);
  /// Σ w μ ∂_aφ_i ∂_bφ_j in block (i, j) at (a, b).
  Eigen::Matrix<double, kRows, kRows> products;
  /// −∫ψ_k ∂_aφ_i at (k, 3i + a).
  Eigen::Matrix<double, 4, kRows> divergence;
  Eigen::Matrix4d stabilisations;  ///< τ∫∇ψ_k·∇ψ_l; zero for P2
  Eigen::Matrix4d masses;          ///< ∫ψ_kψ_l/μ

  CellMatrices(const StokesProblem& problem, std::span<const typename Element::Point> points,
               CellId c);

  /// ∫2μ D(φ_j e_b):D(φ_i e_a) = ∫μ(∇φ_i·∇φ_j δ_ab + ∂_bφ_i ∂_aφ_j) at (a, b).
  [[nodiscard]] Mat3 viscous_block(std::size_t i, std::size_t j) const {
    const auto block = at(i, j);
    Mat3 result = block.transpose();
    result.diagonal().array() += block.trace();
    return result;
  }
  /// ∫μ∇φ_i·∇φ_j.
  [[nodiscard]] double laplacian(std::size_t i, std::size_t j) const { return at(i, j).trace(); }
  [[nodiscard]] Vec3 divergence_of(std::size_t k, std::size_t j) const {
    return divergence.template block<1, 3>(static_cast<Eigen::Index>(k),
                                           static_cast<Eigen::Index>(3 * j));
  }
  [[nodiscard]] double stabilisation(std::size_t k, std::size_t l) const {
    return stabilisations(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
  }
  [[nodiscard]] double consistent_mass(std::size_t k, std::size_t l) const {
    return masses(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
  }
  /// ∫ψ_k/μ.
  [[nodiscard]] double pressure_mass(std::size_t k) const {
    return masses.col(static_cast<Eigen::Index>(k)).sum();
  }
  /// The entry of the lower left block, which is B's in Newtonian liquids.
  [[nodiscard]] Vec3 lower_left_of(std::size_t k, std::size_t j) const {
    return divergence_of(k, j);
  }

 protected:
  CellMatrices();
  void add(const StokesProblem& problem, const typename Element::Point& point, CellId c,
           double viscosity);

 private:
  [[nodiscard]] auto at(std::size_t i, std::size_t j) const {
    return products.template block<3, 3>(static_cast<Eigen::Index>(3 * i),
                                         static_cast<Eigen::Index>(3 * j));
  }
};

template <class Element>
CellMatrices<Element>::CellMatrices() {
  products.setZero();
  divergence.setZero();
  stabilisations.setZero();
  masses.setZero();
}

template <class Element>
void CellMatrices<Element>::add(const StokesProblem& problem, const typename Element::Point& point,
                                CellId c, double viscosity) {
  // The gradients one below the other: row 3i + a holds ∂_aφ_i.
  const Eigen::Map<const Eigen::Matrix<double, kRows, 1>> gradients(point.gradient.data());
  products.noalias() += (point.weight * viscosity * gradients) * gradients.transpose();
  const Eigen::Map<const Eigen::Vector4d> psi(point.pressure.data());
  divergence.noalias() -= (point.weight * psi) * gradients.transpose();
  masses.noalias() += (point.weight / viscosity * psi) * psi.transpose();
  if constexpr (Element::is_stabilized)  // on cells with one point
    stabilisations = stabilisation_parameter(problem, c, point.weight, viscosity) * point.weight *
                     point.gradient.transpose() * point.gradient;
}

template <class Element>
CellMatrices<Element>::CellMatrices(const StokesProblem& problem,
                                    std::span<const typename Element::Point> points, CellId c)
    : CellMatrices() {
  for (const auto& point : points) add(problem, point, c, problem.viscosity[c]);
}

}  // namespace meniscus::fem
