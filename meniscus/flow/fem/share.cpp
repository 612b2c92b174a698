#include "meniscus/flow/fem/share.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/partition.hpp"
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
                                  OwnPart& own) {
  std::vector<CellId> cells, others;
  for (const CellId c : ids<CellId>(space.velocity.num_cells())) {
    const auto corners = space.velocity.of(c).first(4);
    const auto is_own = [&](std::int32_t v) { return rank_of_vertex[at(v)] == rank; };
    if (is_own(corners[0]))
      cells.push_back(c);
    else if (std::ranges::any_of(corners, is_own))
      others.push_back(c);
  }
  own.num_cells = static_cast<std::int32_t>(cells.size());
  cells.insert(cells.end(), others.begin(), others.end());
  return cells;
}

/// One kind of items here, own ones first, and what the cells here have of them.
struct LocalItems {
  std::vector<std::int32_t> of_whole, number;
  std::vector<std::int32_t> here;  ///< of the items of the whole; −1: not here
  NodeTable table;
};

LocalItems local_items(const NodeTable& whole, const Numbering& numbering, int rank,
                       const std::vector<CellId>& cells) {
  LocalItems items;
  const auto first =
      std::accumulate(numbering.counts.begin(), numbering.counts.begin() + rank, std::int32_t{0});
  for (std::int32_t k = 0; k < numbering.counts[at(rank)]; ++k) items.number.push_back(first + k);
  items.here.assign(at(whole.num_nodes), -1);
  std::vector<std::int32_t> others;
  for (const CellId c : cells)
    for (const std::int32_t item : whole.of(c)) {
      const std::int32_t number = numbering.number[at(item)];
      const bool is_own = number >= first && number < first + numbering.counts[at(rank)];
      if (is_own || items.here[at(item)] == 0) continue;
      items.here[at(item)] = 0;  // met
      others.push_back(number);
    }
  std::ranges::sort(others);
  items.number.insert(items.number.end(), others.begin(), others.end());
  for (const std::int32_t number : items.number) {
    const std::int32_t item = numbering.order[at(number)];
    MENISCUS_ASSERT(numbering.number[at(item)] == number, "{} {}", item, number);
    items.here[at(item)] = static_cast<std::int32_t>(items.of_whole.size());
    items.of_whole.push_back(item);
  }
  items.table = {static_cast<std::int32_t>(items.of_whole.size()), whole.nodes_per_cell, {}};
  items.table.cell_nodes.reserve(cells.size() * at(whole.nodes_per_cell));
  for (const CellId c : cells)
    for (const std::int32_t item : whole.of(c)) {
      MENISCUS_ASSERT(items.here[at(item)] >= 0, "item {} of cell {}", item, c.value);
      items.table.cell_nodes.push_back(items.here[at(item)]);
    }
  return items;
}

/// Vertices are numbered among themselves as nodes are.
LinearFunctions local_linear_functions(const FlowSpace& space, const LocalItems& nodes,
                                       const Numbering& vertices, int rank) {
  LinearFunctions coarse;
  if (space.edges.empty()) return coarse;
  coarse.num_own = vertices.counts[at(rank)];
  for (const std::int32_t node : nodes.of_whole) {
    const bool is_vertex = node < space.num_vertices();
    coarse.number.push_back(is_vertex ? vertices.number[at(node)] : -1);
    const std::int32_t here = nodes.here[at(node)];
    if (is_vertex) {
      coarse.ends.push_back({here, here});
      continue;
    }
    const auto& [a, b] = space.edges[at(node - space.num_vertices())];
    coarse.ends.push_back({nodes.here[at(a.value)], nodes.here[at(b.value)]});
  }
  return coarse;
}

std::vector<std::int32_t> tripled(const std::vector<std::int32_t>& counts) {
  std::vector<std::int32_t> result;
  for (const std::int32_t count : counts) result.push_back(3 * count);
  return result;
}

std::vector<double> gathered(std::span<const double> own, const std::vector<std::int32_t>& counts,
                             linear::Communicator communicator) {
  std::vector<double> all(at(std::accumulate(counts.begin(), counts.end(), std::int32_t{0})));
  linear::gather(communicator, own, counts, all);
  return all;
}

}  // namespace

OwnPart all_of(const FlowSpace& space) {
  return {space.velocity.num_nodes, space.pressure.nodes.num_nodes, space.velocity.num_cells()};
}

LinearFunctions linear_functions(const FlowSpace& space) {
  LinearFunctions coarse;
  if (space.edges.empty()) return coarse;
  coarse.num_own = space.num_vertices();
  for (std::int32_t v = 0; v < space.num_vertices(); ++v) {
    coarse.ends.push_back({v, v});
    coarse.number.push_back(v);
  }
  for (const auto& [a, b] : space.edges) coarse.ends.push_back({a.value, b.value});
  return coarse;
}

Numbering numbering(const std::vector<std::int32_t>& rank_of, int num_ranks) {
  Numbering result;
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

std::unique_ptr<const Share> make_share(const FlowSpace& space, linear::Communicator communicator) {
  const int size = communicator.size(), rank = communicator.rank();
  if (size == 1) return nullptr;
  if (!linear::agree(communicator, std::span<const std::int32_t>(space.velocity.cell_nodes)))
    throw RunFailure("the ranks have made different meshes: do their machines differ?");
  const std::vector<std::int32_t> rank_of_vertex = vertex_ranks(space, communicator);
  auto share = std::make_unique<Share>(communicator);
  share->nodes = numbering(ranks_of_nodes(space, rank_of_vertex), size);
  share->pressures = numbering(ranks_of_pressures(space, rank_of_vertex), size);
  share->own.num_nodes = share->nodes.counts[at(rank)];
  share->own.num_pressures = share->pressures.counts[at(rank)];
  share->cell_of_whole = cells_of_rank(space, rank_of_vertex, rank, share->own);

  LocalItems nodes = local_items(space.velocity, share->nodes, rank, share->cell_of_whole);
  LocalItems pressures =
      local_items(space.pressure.nodes, share->pressures, rank, share->cell_of_whole);
  share->coarse = local_linear_functions(space, nodes, numbering(rank_of_vertex, size), rank);
  for (const CellId c : share->cell_of_whole) {
    share->mesh.cells.add({});
    share->mesh.region.add(space.pressure.region[at(space.pressure.nodes.of(c)[0])]);
  }
  for (const std::int32_t node : nodes.of_whole) share->node_of_whole.push_back(NodeId{node});
  share->space.elements = space.elements;
  share->space.velocity = std::move(nodes.table);
  share->space.pressure.nodes = std::move(pressures.table);
  for (const std::int32_t p : pressures.of_whole) {
    share->space.pressure.vertex.push_back(space.pressure.vertex[at(p)]);
    share->space.pressure.region.push_back(space.pressure.region[at(p)]);
  }
  share->pressure_of_whole = std::move(pressures.of_whole);
  share->node_number = std::move(nodes.number);
  share->pressure_number = std::move(pressures.number);
  return share;
}

StokesProblem restricted(const StokesProblem& whole, const Share& share) {
  NodePositions positions;
  for (const NodeId i : share.node_of_whole) positions.x.add(whole.positions.x[i]);
  for (const CellId c : share.cell_of_whole) positions.is_curved.add(whole.positions.is_curved[c]);
  StokesProblem here(share.mesh, share.space, std::move(positions));
  here.share = &share;
  here.laws = whole.laws;
  here.has_open_boundary = whole.has_open_boundary;
  for (const CellId c : here.viscosity.ids()) {
    here.viscosity[c] = whole.viscosity[share.cell_of_whole[at(c.value)]];
    here.body_force[c] = whole.body_force[share.cell_of_whole[at(c.value)]];
  }
  if (!whole.undisturbed.empty())
    for (const NodeId there : share.node_of_whole) here.undisturbed.add(whole.undisturbed[there]);
  for (const NodeId i : here.load.ids()) {
    const NodeId there = share.node_of_whole[at(i.value)];
    here.load[i] = whole.load[there];
    if (const NodeConstraint* constraint = whole.constraints.find(there))
      here.constraints.copy(i, *constraint);
  }
  return here;
}

StokesState restricted(const StokesState& whole, const Share& share) {
  StokesState here;
  for (const NodeId i : share.node_of_whole) here.v.add(whole.v[i]);
  for (const std::int32_t i : share.pressure_of_whole) here.p.push_back(whole.p[at(i)]);
  return here;
}

std::vector<double> completed(std::span<const double> own, const Share& share) {
  const std::size_t num_velocities = 3 * at(share.own.num_nodes);
  const std::vector<double> v = gathered(own.first(num_velocities), tripled(share.nodes.counts),
                                         share.communicator),
                            p = gathered(own.subspan(num_velocities), share.pressures.counts,
                                         share.communicator);
  std::vector<double> here;
  here.reserve(3 * share.node_number.size() + share.pressure_number.size());
  for (const std::int32_t number : share.node_number)
    for (std::size_t k = 0; k < 3; ++k) here.push_back(v[3 * at(number) + k]);
  for (const std::int32_t number : share.pressure_number) here.push_back(p[at(number)]);
  return here;
}

void assemble_whole(const StokesState& here, const Share& share, StokesState& whole) {
  std::vector<double> own;
  own.reserve(3 * at(share.own.num_nodes));
  for (const NodeId i : ids<NodeId>(share.own.num_nodes))
    own.insert(own.end(), here.v[i].begin(), here.v[i].end());
  const std::vector<double> v = gathered(own, tripled(share.nodes.counts), share.communicator);
  const std::vector<double> p = gathered(std::span(here.p).first(at(share.own.num_pressures)),
                                         share.pressures.counts, share.communicator);
  for (std::size_t k = 0; k < share.nodes.order.size(); ++k)
    whole.v[NodeId{share.nodes.order[k]}] = Vec3(v[3 * k], v[3 * k + 1], v[3 * k + 2]);
  for (std::size_t k = 0; k < share.pressures.order.size(); ++k)
    whole.p[at(share.pressures.order[k])] = p[k];
}

}  // namespace meniscus::fem
