#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meniscus/flow/fem/edge_integrals.hpp"
#include "meniscus/flow/fem/liquid_boundary.hpp"
#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// The matrices of linear elements on Newtonian liquids, first summed over the cells around each
/// edge, then written row by row.
///
/// With gradients g_i, block (a, b) of A is μV (g_a·g_b I + g_b g_aᵀ), of B −V/4 g_b, of C τV
/// g_a·g_b. All follow from sums over edges. (b, a) follows from (a, b), and each diagonal block is
/// minus the others of its row, as Σ_b g_b = 0. A cell so adds to six places of two cache lines
/// each, where the matrices themselves would have it add to 96 (docs/benchmark-stokes.md).
///
/// As μ is constant in a liquid, two parts are not summed, but follow from the liquid's boundary Γ:
///   Σ V (g_b g_aᵀ − g_a g_bᵀ) = ∫(∇φ_b ∇φ_aᵀ − ∇φ_a ∇φ_bᵀ) and
///   −Σ V/4 (g_a + g_b) = −∫∇(φ_a φ_b) = −∫_Γ φ_a φ_b n.
/// The first is [Σ V g_a×g_b]×, and V g_a×g_b a sixth of the cell's opposite edge. Around an edge
/// these cancel but for the first and the last, on Γ.
class EdgeSums {
 public:
  /// The graphs are those of A, B and C, columns still numbered as in the space.
  EdgeSums(const FlowSpace& space, const NodeGraph& velocity_graph, const NodeGraph& coupling_graph,
           const NodeGraph& pressure_graph);

  struct Laplacian {
    const std::vector<bool>* is_fixed;  ///< by node
    std::span<double> values;
  };
  /// Values of A and B by blocks as `ScalarPattern` has them.
  struct Matrices {
    const NodeGraph &velocity_graph, &pressure_graph;
    std::span<double> A, B, C;
    std::vector<Laplacian> laplacians;
    std::span<double> pressure_mass;  ///< ∫ψ/μ
  };
  /// Sets the rows of the first so many pressures, and of the nodes that they are at, to what the
  /// given cells make of them. Constraints are eliminated. The cells are all those of some regions,
  /// in their order; viscosity is constant in each region.
  void assemble(const StokesProblem& problem, std::span<const CellId> cells,
                std::int32_t num_pressures, const Matrices& matrices);
  /// Whether the viscosity is constant in each region of a problem, as `assemble` asks.
  [[nodiscard]] static bool can_assemble(const StokesProblem& problem);

 private:
  void add(const StokesProblem& problem, std::span<const CellId> cells);
  void put(const StokesProblem& problem, CellId c, CellBatch& batch, std::size_t m) const;
  void write(const StokesProblem& problem, std::int32_t num_pressures,
             const Matrices& matrices) const;
  [[nodiscard]] std::vector<bool> find_plain_nodes(const Constraints& constraints,
                                                   const Matrices& matrices) const;
  struct Row {
    const Constraints& constraints;
    const Matrices& matrices;
    const NodeConstraint* constraint;
    std::int32_t node;
    std::size_t start, width;  ///< of the node's rows of A, by blocks and by numbers
  };
  template <bool is_plain>
  void write_entry(const Row& row, std::size_t k, const EdgeIntegrals<double>& sums, double turn,
                   bool is_diagonal) const;
  template <bool is_plain>
  void write_row(std::int32_t p, const Constraints& constraints, const Matrices& matrices) const;
  /// A corner of a face of a liquid's boundary. By entries of C: itself, and what joins it to the
  /// next corner and to the one before, counter-clockwise seen from outside.
  struct BoundaryCorner {
    std::int32_t pressure;
    CellId cell;
    std::int32_t own, next, previous;
  };
  void add_boundary(const BoundaryCorner& corner, const StokesProblem& problem,
                    const Matrices& matrices) const;

  /// One for each edge in one liquid, between pressures a < b. Two more follow: one that stays
  /// zero, for diagonal entries, and one that is written to and never read.
  std::vector<EdgeIntegrals<double>> sums_;
  /// 2·edge + whether seen from b: per edge of each cell as in `kCellEdges`, and per entry of C
  /// (longer, for what is fetched ahead).
  std::vector<std::int32_t> cell_edges_, entry_edges_;
  std::vector<std::uint16_t> places_;  ///< per entry of C: the entry of A's row that it adds to
  std::vector<std::int32_t> column_nodes_;  ///< per entry of C
  std::vector<std::int32_t> node_;          ///< of each pressure
  std::vector<bool> is_shared_;             ///< by node: has pressures in several liquids
  std::vector<BoundaryCorner> corners_;     ///< by pressures
};

}  // namespace meniscus::fem
