#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "meniscus/flow/fem/edge_sums.hpp"
#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/share.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/flow/fem/tangent_matrices.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::fem {

/// The Jacobian of R(u) as a saddle system, assembled in place on a sparsity that is made once per
/// mesh topology. At constrained nodes the unknowns are in the constraint's frame.
class StokesJacobian {
 public:
  /// Of a rank's share of the space, the rows of its own nodes, columns numbered as all do.
  explicit StokesJacobian(const FlowSpace& space, const Share* share = nullptr);

  /// Fills the matrices for the geometry, viscosities and constraints of the problem. Linear cost.
  /// Where a liquid is generalised-Newtonian it is linearised about a state, or where none is given
  /// taken for a Newtonian one.
  void assemble(const StokesProblem& problem, const Linearization* about = nullptr);
  /// What preconditioners shall add for constant pressures, by region (region_pressures.hpp).
  /// Holds for the assemblies to come.
  void weigh_constant_pressures(const Field<RegionId, double>& shares);
  /// A view of the last assembly.
  [[nodiscard]] linear::SaddleSystem system() const;

 private:
  void forget_positions();
  void recall_positions();
  void choose_laplacians(const Constraints& constraints);
  [[nodiscard]] Eigen::Map<Vec3> coupling(std::vector<double>& values, CellId c, std::size_t k,
                                          std::size_t j) const;
  /// Whether no node of a cell is constrained.
  [[nodiscard]] bool is_free(const Constraints& constraints, CellId c) const;
  template <class Element>
  void add_cells(const StokesProblem& problem, const Linearization* about,
                 std::span<const CellId> cells, Element& element);
  template <class Matrices>
  void add_cell(const StokesProblem& problem, const Matrices& matrices, CellId c);
  std::vector<CellId> assemble_plain_cells(const StokesProblem& problem,
                                           const Linearization* about);
  template <class Matrices>
  void add_free_cell(const Matrices& matrices, CellId c);
  template <class Matrices>
  void add_constrained_cell(const StokesProblem& problem, const Matrices& matrices, CellId c);
  template <class Matrices>
  void add_lower_left(const StokesProblem& problem, const Matrices& matrices, CellId c);
  void weigh_regions();
  template <class Matrices>
  void add_pressure_blocks(const Matrices& matrices, CellId c);

  /// A scalar Laplacian with the nodes eliminated where a velocity component is fixed, and (P2) the
  /// interpolation to it from linear functions that vanish there.
  struct Laplacian {
    std::vector<bool> is_fixed;
    std::vector<double> values;
    linear::CsrMatrix from_linear;
  };

  /// Whether all ranks agree that the same nodes are fixed in two components.
  [[nodiscard]] bool is_same(const std::vector<bool>& a, const std::vector<bool>& b) const;

  const FlowSpace& space_;
  const Share* share_;
  OwnPart own_;
  LinearFunctions coarse_;
  /// Without positions while all cells are summed by edges.
  NodeGraph velocity_graph_, coupling_graph_, pressure_graph_;
  std::optional<EdgeSums> edge_sums_;  ///< of P1-P1 alone
  ScalarPattern A_pattern_, B_pattern_;
  std::vector<double> A_, B_, C_, pressure_mass_;
  std::vector<double> consistent_mass_;  ///< on C's pattern; of P2-P1 alone
  std::vector<std::int32_t> region_of_pressure_;
  std::vector<double> region_shares_, region_weights_;  ///< of constant pressures
  std::vector<double> lower_left_;                      ///< on B's pattern; empty where it is B
  std::vector<Laplacian> laplacians_;
  std::array<int, 3> laplacian_of_ = {0, 0, 0};
  bool constant_pressure_is_null_ = false;
};

}  // namespace meniscus::fem
