#pragma once

#include <memory>

#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/linear/communicator.hpp"

namespace meniscus::fem {

/// What of a space a rank answers for: the first so many. All of it on one rank.
struct OwnPart {
  std::int32_t num_nodes = 0, num_pressures = 0, num_cells = 0;
};
[[nodiscard]] OwnPart all_of(const FlowSpace& space);

/// How the linear functions of a mesh make quadratic ones, by node: a vertex has its own value, a
/// mid-edge node the mean of its ends.
struct LinearFunctions {
  std::vector<std::array<std::int32_t, 2>> ends;  ///< nodes; a vertex is both ends of itself
  std::vector<std::int32_t> number;               ///< of a node that is a vertex, among all such
  std::int32_t num_own = 0;
};
/// Empty for P1.
[[nodiscard]] LinearFunctions linear_functions(const FlowSpace& space);

/// How all ranks number what they share: rank by rank, in the order of the whole.
struct Numbering {
  std::vector<std::int32_t> counts;  ///< by rank
  std::vector<std::int32_t> number;  ///< of each item of the whole
  std::vector<std::int32_t> order;   ///< the item of each number
};
[[nodiscard]] Numbering numbering(const std::vector<std::int32_t>& rank_of, int num_ranks);

/// The part of a space that one rank works on: the cells that touch its nodes, with all their
/// nodes, as a space of its own. Its own cells, nodes and pressures come first; of the others,
/// which come in the order of their numbers, only the values are known, and rows would lack the
/// cells beyond. Whatever sums over cells gives its own rows whole.
struct Share {
  explicit Share(linear::Communicator of) : communicator(of) {}

  linear::Communicator communicator;
  OwnPart own;
  TetMesh mesh;     ///< the cells' number and regions, no more
  FlowSpace space;  ///< without edges
  LinearFunctions coarse;
  Numbering nodes, pressures;         ///< of the whole space
  std::vector<CellId> cell_of_whole;  ///< of each cell here
  std::vector<NodeId> node_of_whole;  ///< of each node here
  std::vector<std::int32_t> pressure_of_whole;
  std::vector<std::int32_t> node_number, pressure_number;  ///< in the system that all share
};
/// Null on one rank. Throws RunFailure when the ranks differ about the space, as they may on
/// different machines. Collective.
[[nodiscard]] std::unique_ptr<const Share> make_share(const FlowSpace& space,
                                                      linear::Communicator communicator);

/// Of a problem's space.
[[nodiscard]] inline OwnPart own_part(const StokesProblem& problem) {
  return problem.share == nullptr ? all_of(problem.space) : problem.share->own;
}

[[nodiscard]] StokesProblem restricted(const StokesProblem& whole, const Share& share);
[[nodiscard]] StokesState restricted(const StokesState& whole, const Share& share);
/// The unknowns of the nodes here, velocities before pressures, from those of the own ones.
/// Collective.
[[nodiscard]] std::vector<double> completed(std::span<const double> own, const Share& share);
/// The whole state from its shares. Collective.
void assemble_whole(const StokesState& here, const Share& share, StokesState& whole);

}  // namespace meniscus::fem
