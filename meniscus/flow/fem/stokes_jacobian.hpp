#pragma once

#include <optional>
#include <vector>

#include "meniscus/flow/fem/cell_assembly.hpp"
#include "meniscus/flow/fem/edge_sums.hpp"
#include "meniscus/flow/fem/region_weights.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/flow/fem/tangent_matrices.hpp"

namespace meniscus::fem {

/// The Jacobian of R(u) as a saddle system, assembled in place on a sparsity that is made once per
/// mesh topology. At constrained nodes the unknowns are in the constraint's frame.
class StokesJacobian {
 public:
  /// With a partition `space` is its local space: the matrices have the rows of the owned nodes,
  /// and columns as the index maps number them.
  explicit StokesJacobian(const FlowSpace& space, const Partition* partition = nullptr);

  /// Fills the matrices for the geometry, viscosities and constraints of the problem. Linear cost.
  /// Where a liquid is generalised-Newtonian it is linearised about a state, or where none is given
  /// taken for a Newtonian one. With inertia, of linear elements alone, the state's velocity
  /// convects; where none is given nothing does.
  void assemble(const StokesProblem& problem, const Linearization* about = nullptr);
  /// Sets the weights of constant pressures in preconditioners, by region (region_pressures.hpp),
  /// for all later assemblies.
  void weigh_constant_pressures(const Field<RegionId, double>& shares) {
    region_weights_.set_shares(shares);
  }
  /// A view of the last assembly.
  [[nodiscard]] linear::SaddleSystem system() const;

 private:
  void clear_values(bool has_lower_left);
  std::vector<CellId> assemble_plain_cells(const StokesProblem& problem,
                                           const Linearization* about);
  void assemble_inertial_cells(const StokesProblem& problem, const Linearization* about,
                               CellAssembly& assembly);
  void add_tension(const InertiaTerms& terms, const Constraints& constraints);

  const FlowSpace& space_;
  OwnedCounts owned_;
  StokesSparsity sparsity_;
  std::optional<EdgeSums> edge_sums_;      ///< of P1-P1 alone
  std::vector<std::int32_t> node_number_;  ///< of the columns, by node
  ScalarLaplacians laplacians_;
  RegionWeights region_weights_;
  StokesValues values_;
  std::vector<double> lumped_masses_;  ///< ∫ρφ_i/T of the velocities, with inertia
  bool constant_pressure_is_null_ = false;
};

}  // namespace meniscus::fem
