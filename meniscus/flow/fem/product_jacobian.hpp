#pragma once

#include <optional>
#include <vector>

#include "meniscus/flow/fem/free_product.hpp"
#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/region_weights.hpp"
#include "meniscus/flow/fem/scalar_laplacians.hpp"
#include "meniscus/linear/saddle_solver.hpp"

namespace meniscus::fem {

struct LinearIntegrals;

/// The Jacobian of R(u), for quadratic elements on Newtonian liquids, as a saddle system that is
/// given by its products. Matrices are made of what preconditioners need: the mass matrix of the
/// pressures, and the Laplacians of linear functions. These are multigrid's coarse level.
class ProductJacobian {
 public:
  /// As `StokesJacobian`'s.
  explicit ProductJacobian(const FlowSpace& space, const Partition* partition = nullptr);

  /// The problem and the product, which is the problem's, must outlive the system. Where the
  /// preconditioner is kept, what only its making takes stays as it was.
  void assemble(const StokesProblem& problem, const StokesProduct& product,
                linear::Preconditioner preconditioner);
  void weigh_constant_pressures(const Field<RegionId, double>& shares) {
    region_weights_.set_shares(shares);
  }
  /// A view of the last assembly.
  [[nodiscard]] linear::SaddleSystem system() const;

 private:
  void assemble_preconditioner(const StokesProblem& problem, const StokesProduct& product);
  /// Of a cell, whose integrals are those of a lane.
  void add_pressure_mass(const StokesProblem& problem, CellId c, const LinearIntegrals& integrals,
                         std::size_t lane);
  void add_laplacians(const StokesProblem& problem, CellId c, const LinearIntegrals& integrals,
                      std::size_t lane);
  void add_tension(const InertiaTerms& terms);
  void assemble_divergence(const StokesProblem& problem, const InertiaProduct& inertia);

  const FlowSpace& space_;
  OwnedCounts owned_;
  LinearFunctions coarse_;
  std::vector<std::int32_t> vertex_of_;  ///< by node; −1 at the middles of edges
  NodeTable vertices_;                   ///< of each cell
  NodeGraph vertex_graph_, pressure_graph_;
  NodeGraph divergence_graph_;         ///< pressures by nodes; empty until inertia needs it
  linear::CsrMatrix divergence_;       ///< −∫ψ∇·φ of the free unknowns; only with inertia
  std::vector<double> mass_diagonal_;  ///< ∫ρφ_iφ_i/τ of the owned velocities
  ScalarLaplacians laplacians_;
  RegionWeights region_weights_;
  const Partition* partition_;
  LaplacianMatrix laplacian_;  ///< of quadratic functions, of the smoother
  std::vector<double> pressure_mass_, consistent_mass_, diagonals_;
  std::optional<FreeProduct> product_;
  bool constant_pressure_is_null_ = false;
};

}  // namespace meniscus::fem
