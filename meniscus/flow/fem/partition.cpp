#include "meniscus/flow/fem/partition.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/vertex_ranks.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Mid-edge nodes go with the lower of their ends.
std::vector<std::int32_t> ranks_of_nodes(const FlowSpace& space,
                                         std::vector<std::int32_t> rank_of_vertex) {
  std::vector<std::int32_t> rank = std::move(rank_of_vertex);
  for (const auto& ends : space.edges) rank.push_back(rank[at(ends[0].value)]);
  return rank;
}

std::vector<std::int32_t> ranks_of_pressures(const FlowSpace& space,
                                             const std::vector<std::int32_t>& rank_of_vertex) {
  std::vector<std::int32_t> rank;
  rank.reserve(space.pressure.vertex.size());
  for (const TetVertexId v : space.pressure.vertex) rank.push_back(rank_of_vertex[at(v.value)]);
  return rank;
}

/// The cells that touch a rank's vertices, and thereby its nodes; first those whose first vertex is
/// one.
std::vector<CellId> cells_of_rank(const FlowSpace& space,
                                  const std::vector<std::int32_t>& rank_of_vertex, int rank,
                                  OwnedCounts& owned) {
  std::vector<CellId> cells, others;
  for (const CellId c : ids<CellId>(space.velocity.num_cells())) {
    const auto corners = space.velocity.of(c).first(4);
    const auto is_owned = [&](std::int32_t v) { return rank_of_vertex[at(v)] == rank; };
    if (is_owned(corners[0]))
      cells.push_back(c);
    else if (std::ranges::any_of(corners, is_owned))
      others.push_back(c);
  }
  owned.num_cells = static_cast<std::int32_t>(cells.size());
  cells.insert(cells.end(), others.begin(), others.end());
  return cells;
}

/// The local items of one kind, owned ones first, and what the local cells have of them.
struct LocalItems {
  std::vector<std::int32_t> global, number;
  std::vector<std::int32_t> local;  ///< of each global item; −1: none
  NodeTable table;
};

LocalItems local_items(const NodeTable& global, const IndexMap& map, int rank,
                       const std::vector<CellId>& cells) {
  LocalItems items;
  const auto first =
      std::accumulate(map.counts.begin(), map.counts.begin() + rank, std::int32_t{0});
  for (std::int32_t k = 0; k < map.counts[at(rank)]; ++k) items.number.push_back(first + k);
  items.local.assign(at(global.num_nodes), -1);
  std::vector<std::int32_t> others;
  for (const CellId c : cells)
    for (const std::int32_t item : global.of(c)) {
      const std::int32_t number = map.number[at(item)];
      const bool is_owned = number >= first && number < first + map.counts[at(rank)];
      if (is_owned || items.local[at(item)] == 0) continue;
      items.local[at(item)] = 0;  // met
      others.push_back(number);
    }
  std::ranges::sort(others);
  items.number.insert(items.number.end(), others.begin(), others.end());
  for (const std::int32_t number : items.number) {
    const std::int32_t item = map.order[at(number)];
    MENISCUS_ASSERT(map.number[at(item)] == number, "{} {}", item, number);
    items.local[at(item)] = static_cast<std::int32_t>(items.global.size());
    items.global.push_back(item);
  }
  items.table = {static_cast<std::int32_t>(items.global.size()), global.nodes_per_cell, {}};
  items.table.cell_nodes.reserve(cells.size() * at(global.nodes_per_cell));
  for (const CellId c : cells)
    for (const std::int32_t item : global.of(c)) {
      MENISCUS_ASSERT(items.local[at(item)] >= 0, "item {} of cell {}", item, c.value);
      items.table.cell_nodes.push_back(items.local[at(item)]);
    }
  return items;
}

/// The index map of vertices alone numbers them in the order that nodes have.
LinearFunctions local_linear_functions(const FlowSpace& space, const LocalItems& nodes,
                                       const IndexMap& vertices, int rank) {
  LinearFunctions coarse;
  if (space.edges.empty()) return coarse;
  coarse.num_owned = vertices.counts[at(rank)];
  for (const std::int32_t node : nodes.global) {
    const bool is_vertex = node < space.num_vertices();
    coarse.number.push_back(is_vertex ? vertices.number[at(node)] : -1);
    const std::int32_t local = nodes.local[at(node)];
    if (is_vertex) {
      coarse.ends.push_back({local, local});
      continue;
    }
    const auto& [a, b] = space.edges[at(node - space.num_vertices())];
    coarse.ends.push_back({nodes.local[at(a.value)], nodes.local[at(b.value)]});
  }
  return coarse;
}

std::vector<std::int32_t> velocity_counts(const std::vector<std::int32_t>& counts) {
  std::vector<std::int32_t> result;
  result.reserve(counts.size());
  for (const std::int32_t count : counts) result.push_back(3 * count);
  return result;
}

std::vector<double> of_all_ranks(std::span<const double> owned,
                                 const std::vector<std::int32_t>& counts,
                                 linear::Communicator communicator) {
  std::vector<double> all(at(std::accumulate(counts.begin(), counts.end(), std::int32_t{0})));
  linear::gather(communicator, owned, counts, all);
  return all;
}

}  // namespace

OwnedCounts all_owned(const FlowSpace& space) {
  return {space.velocity.num_nodes, space.pressure.nodes.num_nodes, space.velocity.num_cells()};
}

LinearFunctions linear_functions(const FlowSpace& space) {
  LinearFunctions coarse;
  if (space.edges.empty()) return coarse;
  coarse.num_owned = space.num_vertices();
  for (std::int32_t v = 0; v < space.num_vertices(); ++v) {
    coarse.ends.push_back({v, v});
    coarse.number.push_back(v);
  }
  for (const auto& [a, b] : space.edges) coarse.ends.push_back({a.value, b.value});
  return coarse;
}

IndexMap index_map(const std::vector<std::int32_t>& rank_of, int num_ranks) {
  IndexMap result;
  result.counts.assign(at(num_ranks), 0);
  for (const std::int32_t rank : rank_of) ++result.counts[at(rank)];
  std::vector<std::int32_t> next(at(num_ranks), 0);
  std::exclusive_scan(result.counts.begin(), result.counts.end(), next.begin(), 0);
  result.number.reserve(rank_of.size());
  result.order.resize(rank_of.size());
  for (std::size_t item = 0; item < rank_of.size(); ++item) {
    const std::int32_t number = next[at(rank_of[item])]++;
    result.number.push_back(number);
    result.order[at(number)] = static_cast<std::int32_t>(item);
  }
  return result;
}

std::unique_ptr<const Partition> make_partition(const FlowSpace& space,
                                                linear::Communicator communicator) {
  const int size = communicator.size(), rank = communicator.rank();
  if (size == 1) return nullptr;
  if (!linear::agree(communicator, std::span<const std::int32_t>(space.velocity.cell_nodes)))
    throw RunFailure("the ranks have made different meshes: do their machines differ?");
  const std::vector<std::int32_t> rank_of_vertex = vertex_ranks(space, communicator);
  auto partition = std::make_unique<Partition>(communicator);
  partition->nodes = index_map(ranks_of_nodes(space, rank_of_vertex), size);
  partition->pressures = index_map(ranks_of_pressures(space, rank_of_vertex), size);
  partition->owned.num_nodes = partition->nodes.counts[at(rank)];
  partition->owned.num_pressures = partition->pressures.counts[at(rank)];
  partition->global_cell = cells_of_rank(space, rank_of_vertex, rank, partition->owned);

  LocalItems nodes = local_items(space.velocity, partition->nodes, rank, partition->global_cell);
  LocalItems pressures =
      local_items(space.pressure.nodes, partition->pressures, rank, partition->global_cell);
  partition->coarse = local_linear_functions(space, nodes, index_map(rank_of_vertex, size), rank);
  for (const CellId c : partition->global_cell) {
    partition->mesh.cells.add({});
    partition->mesh.region.add(space.pressure.region[at(space.pressure.nodes.of(c)[0])]);
  }
  for (const std::int32_t node : nodes.global) partition->global_node.push_back(NodeId{node});
  partition->space.elements = space.elements;
  partition->space.velocity = std::move(nodes.table);
  partition->space.pressure.nodes = std::move(pressures.table);
  for (const std::int32_t p : pressures.global) {
    partition->space.pressure.vertex.push_back(space.pressure.vertex[at(p)]);
    partition->space.pressure.region.push_back(space.pressure.region[at(p)]);
  }
  partition->global_pressure = std::move(pressures.global);
  partition->node_number = std::move(nodes.number);
  partition->pressure_number = std::move(pressures.number);
  const auto& [num_nodes, num_pressures, num_cells] = partition->owned;
  partition->ghost_velocities.emplace(communicator, num_nodes,
                                      std::span(partition->node_number).subspan(at(num_nodes)), 3);
  partition->ghost_pressures.emplace(
      communicator, num_pressures, std::span(partition->pressure_number).subspan(at(num_pressures)),
      1);
  return partition;
}

namespace {

/// Owned values and those of ghosts after them, `size` in all. There is room for one more, which
/// Laplacians want.
std::vector<double> with_fetched(std::span<const double> owned, const linear::GhostValues& ghosts,
                                 std::size_t size) {
  std::vector<double> local;
  local.reserve(size + 1);
  local.assign(owned.begin(), owned.end());
  local.resize(size);
  ghosts.fetch(owned, std::span(local).subspan(owned.size()));
  return local;
}

/// Faces with a node that is not local, or with none that is owned, give nothing to owned rows.
InertiaTerms local_part(const InertiaTerms& global, const Partition& partition) {
  InertiaTerms local{.duration = global.duration};
  for (const CellId c : partition.global_cell) {
    local.density.add(global.density[c]);
    if (!global.remembered_divergence.empty())
      local.remembered_divergence.add(global.remembered_divergence[c]);
  }
  Field<NodeId, std::int32_t> number(global.before.size(), -1);
  for (std::size_t i = 0; i < partition.global_node.size(); ++i) {
    const NodeId from = partition.global_node[i];
    number[from] = static_cast<std::int32_t>(i);
    local.before.add(global.before[from]);
    local.mesh_velocity.add(global.mesh_velocity[from]);
    local.interface_went.add(global.interface_went[from]);
  }
  const auto take = [&](auto face, auto& to) {
    for (NodeId& node : face.nodes) node = NodeId{number[node]};
    const auto is_owned = [&](NodeId node) {
      return node.value >= 0 && node.value < partition.owned.num_nodes;
    };
    if (std::ranges::none_of(face.nodes, [](NodeId node) { return node.value < 0; }) &&
        std::ranges::any_of(face.nodes, is_owned))
      to.push_back(std::move(face));
  };
  for (const FaceStiffness& face : global.tension) take(face, local.tension);
  for (const FaceElasticity& face : global.elasticity) take(face, local.elasticity);
  return local;
}

}  // namespace

StokesProblem local_part(const StokesProblem& global, const Partition& partition) {
  NodePositions positions;
  const auto num_nodes = static_cast<std::int32_t>(partition.global_node.size());
  positions.x.reserve(num_nodes);
  positions.is_curved.reserve(static_cast<std::int32_t>(partition.global_cell.size()));
  for (const NodeId i : partition.global_node) positions.x.add(global.positions.x[i]);
  for (const CellId c : partition.global_cell)
    positions.is_curved.add(global.positions.is_curved[c]);
  StokesProblem local(partition.mesh, partition.space, std::move(positions));
  local.partition = &partition;
  local.laws = global.laws;
  local.has_open_boundary = global.has_open_boundary;
  for (const CellId c : local.viscosity.ids()) {
    local.viscosity[c] = global.viscosity[partition.global_cell[at(c.value)]];
    local.body_force[c] = global.body_force[partition.global_cell[at(c.value)]];
  }
  if (!global.undisturbed.empty()) local.undisturbed.reserve(num_nodes);
  if (!global.undisturbed.empty())
    for (const NodeId i_global : partition.global_node)
      local.undisturbed.add(global.undisturbed[i_global]);
  if (global.inertia) local.inertia = local_part(*global.inertia, partition);
  for (const NodeId i : local.force.ids()) {
    const NodeId i_global = partition.global_node[at(i.value)];
    local.force[i] = global.force[i_global];
    if (const NodeConstraint* constraint = global.constraints.find(i_global))
      local.constraints.copy(i, *constraint);
  }
  return local;
}

StokesState local_part(const StokesState& global, const Partition& partition) {
  StokesState local;
  local.v.reserve(static_cast<std::int32_t>(partition.global_node.size()));
  local.p.reserve(partition.global_pressure.size());
  for (const NodeId i : partition.global_node) local.v.add(global.v[i]);
  for (const std::int32_t i : partition.global_pressure) local.p.push_back(global.p[at(i)]);
  return local;
}

std::vector<double> velocities_with_ghosts(std::span<const double> owned,
                                           const Partition& partition) {
  return with_fetched(owned, *partition.ghost_velocities, 3 * partition.node_number.size());
}

std::vector<double> pressures_with_ghosts(std::span<const double> owned,
                                          const Partition& partition) {
  return with_fetched(owned, *partition.ghost_pressures, partition.pressure_number.size());
}

void add_of_ghosts(const Partition& partition, std::span<double> velocities,
                   std::span<double> pressures) {
  const auto give = [](const linear::GhostValues& ghosts, std::span<double> local,
                       std::size_t num_owned) {
    if (!local.empty()) ghosts.give(local.subspan(num_owned), local.first(num_owned));
  };
  give(*partition.ghost_velocities, velocities, 3 * at(partition.owned.num_nodes));
  give(*partition.ghost_pressures, pressures, at(partition.owned.num_pressures));
}

std::vector<double> with_ghosts(std::span<const double> owned, const Partition& partition) {
  const std::size_t num_velocities = 3 * at(partition.owned.num_nodes);
  std::vector<double> local = velocities_with_ghosts(owned.first(num_velocities), partition);
  const std::vector<double> p = pressures_with_ghosts(owned.subspan(num_velocities), partition);
  local.insert(local.end(), p.begin(), p.end());
  return local;
}

void gather_state(const StokesState& local, const Partition& partition, StokesState& global) {
  std::vector<double> owned;
  owned.reserve(3 * at(partition.owned.num_nodes));
  for (const NodeId i : ids<NodeId>(partition.owned.num_nodes))
    owned.insert(owned.end(), local.v[i].begin(), local.v[i].end());
  const std::vector<double> v =
      of_all_ranks(owned, velocity_counts(partition.nodes.counts), partition.communicator);
  const std::vector<double> p =
      of_all_ranks(std::span(local.p).first(at(partition.owned.num_pressures)),
                   partition.pressures.counts, partition.communicator);
  for (std::size_t k = 0; k < partition.nodes.order.size(); ++k)
    global.v[NodeId{partition.nodes.order[k]}] = Vec3(v[3 * k], v[3 * k + 1], v[3 * k + 2]);
  for (std::size_t k = 0; k < partition.pressures.order.size(); ++k)
    global.p[at(partition.pressures.order[k])] = p[k];
}

}  // namespace meniscus::fem
