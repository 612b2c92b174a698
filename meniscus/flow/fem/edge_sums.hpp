#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// The matrices of linear elements on Newtonian liquids, first summed over the cells around each
/// edge, then written row by row.
///
/// With gradients g_i, block (a, b) of A is μV (g_a·g_b I + g_b g_aᵀ), of B −V/4 g_b, of C
/// τV g_a·g_b. All follow from sums over edges: (b, a) from (a, b), and each diagonal block is
/// minus the others of its row, as Σ_b g_b = 0. A cell so adds to six places of two cache lines
/// each, where the matrices themselves would have it add to 96 (docs/benchmark-stokes.md).
class EdgeSums {
 public:
  /// Of the sparsities of A, B and C before their columns are renumbered.
  EdgeSums(const FlowSpace& space, const NodeGraph& velocity_graph, const NodeGraph& coupling_graph,
           const NodeGraph& pressure_graph);

  void clear();
  /// Adds ∫ψ/μ to the pressures as well.
  void add(const StokesProblem& problem, std::span<const CellId> cells,
           std::span<double> pressure_mass);

  struct Laplacian {
    const std::vector<bool>* is_fixed;  ///< by node
    std::span<double> values;
  };
  /// Values of A and B by blocks as `ScalarPattern` has them.
  struct Matrices {
    std::span<double> A, B, C;
    std::vector<Laplacian> laplacians;
  };
  /// Sets the rows of the first so many pressures and of the nodes that they are at, with
  /// constraints eliminated.
  void write(const NodeGraph& velocity_graph, const NodeGraph& pressure_graph,
             std::int32_t num_pressures, const Constraints& constraints,
             const Matrices& matrices) const;

 private:
  /// Of the pressures a < b at the ends of an edge in one liquid: Σ (μV g_a, −V/4)(g_b, −1/(4μ))ᵀ,
  /// but for Σ τV g_a·g_b in the last corner.
  struct alignas(128) Sums {
    Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  };
  void add_cell(CellId c, const LinearTetrahedron& cell, double viscosity, double stabilisation);
  template <class Put>
  void write_row(std::int32_t p, const NodeGraph& velocity_graph, const NodeGraph& pressure_graph,
                 const Constraints& constraints, const Matrices& matrices, const Put& put) const;

  std::vector<Sums> sums_;
  /// 2·edge + whether seen from b, per edge of each cell as in `kCellEdges`, and per entry of C,
  /// −1 on its diagonal; that one is longer, for what is fetched ahead.
  std::vector<std::int32_t> cell_edges_, entry_edges_;
  std::vector<std::uint16_t> places_;  ///< per entry of C: the entry of A's row that it adds to
  std::vector<std::int32_t> column_nodes_;  ///< per entry of C
  std::vector<std::int32_t> node_;          ///< of each pressure
  std::vector<bool> is_shared_;             ///< by node: has pressures in several liquids
};

}  // namespace meniscus::fem
