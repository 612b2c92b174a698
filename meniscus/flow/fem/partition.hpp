#pragma once

#include <memory>
#include <optional>

#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/linear/communicator.hpp"
#include "meniscus/linear/ghost_values.hpp"

namespace meniscus::fem {

/// How many nodes, pressures and cells of a space a rank owns. They come first in its numbering; on
/// one rank they are all there are.
struct OwnedCounts {
  std::int32_t num_nodes = 0, num_pressures = 0, num_cells = 0;
};
[[nodiscard]] OwnedCounts all_owned(const FlowSpace& space);

/// How the linear functions of a mesh make quadratic ones, by node. A vertex has its own value, a
/// mid-edge node the mean of its ends.
struct LinearFunctions {
  std::vector<std::array<std::int32_t, 2>> ends;  ///< nodes; a vertex is both ends of itself
  std::vector<std::int32_t> number;               ///< of a node that is a vertex, among all such
  std::int32_t num_owned = 0;
};
/// Empty for P1.
[[nodiscard]] LinearFunctions linear_functions(const FlowSpace& space);

/// How items of a mesh are numbered for the ranks: those of rank 0 first, then those of rank 1, ….
/// Each keeps the order that they have in the mesh.
struct IndexMap {
  std::vector<std::int32_t> counts;  ///< items by rank
  std::vector<std::int32_t> number;  ///< of each item
  std::vector<std::int32_t> order;   ///< the item of each number
};
[[nodiscard]] IndexMap index_map(const std::vector<std::int32_t>& rank_of, int num_ranks);

/// One rank's part of a space: the cells that touch the nodes it owns, with all their nodes, as a
/// local space. Owned cells, nodes and pressures come first. The others are ghosts, in the order of
/// their numbers: their values are known, but their rows would lack cells of other ranks. A sum
/// over the local cells gives every owned row completely.
struct Partition {
  explicit Partition(linear::Communicator of) : communicator(of) {}

  linear::Communicator communicator;
  OwnedCounts owned;
  TetMesh mesh;     ///< only the number of cells and their regions
  FlowSpace space;  ///< without edges
  LinearFunctions coarse;
  IndexMap nodes, pressures;                               ///< of the global space
  std::vector<CellId> global_cell;                         ///< of each local cell
  std::vector<NodeId> global_node;                         ///< of each local node
  std::vector<std::int32_t> global_pressure;               ///< of each local pressure
  std::vector<std::int32_t> node_number, pressure_number;  ///< of each local one in the index map
  std::optional<linear::GhostValues> ghost_velocities, ghost_pressures;
};
/// Null on one rank. Throws RunFailure when the ranks differ about the space, as they may on
/// different machines. Collective.
[[nodiscard]] std::unique_ptr<const Partition> make_partition(const FlowSpace& space,
                                                              linear::Communicator communicator);

/// What this rank owns of the space of a problem.
[[nodiscard]] inline OwnedCounts owned_counts(const StokesProblem& problem) {
  return problem.partition == nullptr ? all_owned(problem.space) : problem.partition->owned;
}

/// A global problem or its state as one rank sees it.
[[nodiscard]] StokesProblem local_part(const StokesProblem& global, const Partition& partition);
[[nodiscard]] StokesState local_part(const StokesState& global, const Partition& partition);
/// The unknowns of all local nodes, velocities before pressures, from those of the owned ones.
/// Collective.
[[nodiscard]] std::vector<double> with_ghosts(std::span<const double> owned,
                                              const Partition& partition);
/// Three numbers for each local node, and one for each local pressure, from the owned ones'.
/// Collective.
[[nodiscard]] std::vector<double> velocities_with_ghosts(std::span<const double> owned,
                                                         const Partition& partition);
[[nodiscard]] std::vector<double> pressures_with_ghosts(std::span<const double> owned,
                                                        const Partition& partition);
/// Adds to what each rank has of the owned velocities and pressures (or of what is tested with
/// them) what other ranks have of them as ghosts. Empty pressures are none. Collective.
void add_of_ghosts(const Partition& partition, std::span<double> velocities,
                   std::span<double> pressures);
/// Gathers the owned parts of all ranks' states into every rank's global state. Collective.
void gather_state(const StokesState& local, const Partition& partition, StokesState& global);

}  // namespace meniscus::fem
