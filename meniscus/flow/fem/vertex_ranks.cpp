#include "meniscus/flow/fem/vertex_ranks.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"
#include "meniscus/linear/graph_partition.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Rows of numbers, one after the other.
struct Rows {
  std::vector<std::int32_t> first, entries;
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t row) const {
    return std::span(entries).subspan(at(first[at(row)]), at(first[at(row) + 1] - first[at(row)]));
  }
};

std::span<const std::int32_t> corners(const FlowSpace& space, std::int32_t cell) {
  return space.velocity.of(CellId{cell}).first(4);
}

/// The members of each of `num_rows` classes, in rising order.
template <class ClassesOf>
Rows members(std::int32_t num_rows, std::int32_t num_members, ClassesOf classes_of) {
  Rows rows;
  rows.first.assign(at(num_rows) + 1, 0);
  for (std::int32_t i = 0; i < num_members; ++i)
    for (const std::int32_t row : classes_of(i)) ++rows.first[at(row) + 1];
  for (std::size_t i = 0; i < at(num_rows); ++i) rows.first[i + 1] += rows.first[i];
  rows.entries.resize(at(rows.first.back()));
  std::vector<std::int32_t> next(rows.first.begin(), rows.first.end() - 1);
  for (std::int32_t i = 0; i < num_members; ++i)
    for (const std::int32_t row : classes_of(i)) rows.entries[at(next[at(row)]++)] = i;
  return rows;
}

Rows cells_around_vertices(const FlowSpace& space) {
  return members(space.num_vertices(), space.velocity.num_cells(),
                 [&](std::int32_t cell) { return corners(space, cell); });
}

std::vector<std::int32_t> groups_of(const FlowSpace& space, const Rows& cells) {
  std::vector<std::int32_t> group(at(space.num_vertices()), -1);
  const auto any_neighbour = [&](std::int32_t vertex, auto holds) {
    return std::ranges::any_of(cells.of(vertex), [&](std::int32_t cell) {
      return std::ranges::any_of(corners(space, cell), holds);
    });
  };
  std::int32_t count = 0;
  for (std::int32_t v = 0; v < space.num_vertices(); ++v) {
    if (any_neighbour(v, [&](std::int32_t w) { return group[at(w)] >= 0; })) continue;
    group[at(v)] = count;
    for (const std::int32_t cell : cells.of(v))
      for (const std::int32_t w : corners(space, cell)) group[at(w)] = count;
    ++count;
  }
  // Whoever is left has such a neighbour: that kept him from making a group.
  for (std::int32_t v = 0; v < space.num_vertices(); ++v)
    if (group[at(v)] < 0)
      any_neighbour(v, [&](std::int32_t w) {
        group[at(v)] = group[at(w)];
        return group[at(w)] >= 0;
      });
  return group;
}

/// Groups that share cells are neighbours, by how many cells have their first edge between them. Of
/// six edges one is enough to tell where many cells would be cut. A group weighs as many as there
/// are cells around its vertices, which is what their rows cost.
linear::WeightedGraph group_graph(const FlowSpace& space, const Rows& cells,
                                  const std::vector<std::int32_t>& group) {
  const std::int32_t num_groups = 1 + std::ranges::max(group);
  linear::WeightedGraph graph;
  graph.vertex_weights.assign(at(num_groups), 0);
  for (std::int32_t v = 0; v < space.num_vertices(); ++v)
    graph.vertex_weights[at(group[at(v)])] += static_cast<std::int32_t>(cells.of(v).size());
  std::vector<std::array<std::int32_t, 2>> joins;
  joins.reserve(at(space.velocity.num_cells()));
  for (std::int32_t cell = 0; cell < space.velocity.num_cells(); ++cell) {
    const auto vertices = corners(space, cell);
    const std::int32_t a = group[at(vertices[0])], b = group[at(vertices[1])];
    if (a != b) joins.push_back({a, b});
  }
  const Rows joins_of = members(num_groups, static_cast<std::int32_t>(joins.size()),
                                [&](std::int32_t join) { return std::span(joins[at(join)]); });
  graph.row_start.push_back(0);
  std::vector<std::int32_t> count(at(num_groups), 0), met;
  for (std::int32_t g = 0; g < num_groups; ++g) {
    met.clear();
    for (const std::int32_t join : joins_of.of(g)) {
      const auto& [a, b] = joins[at(join)];
      const std::int32_t other = a + b - g;
      if (count[at(other)]++ == 0) met.push_back(other);
    }
    std::ranges::sort(met);
    for (const std::int32_t other : met) {
      graph.neighbours.push_back(other);
      graph.edge_weights.push_back(std::exchange(count[at(other)], 0));
    }
    graph.row_start.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace

std::vector<std::int32_t> vertex_groups(const FlowSpace& space) {
  return groups_of(space, cells_around_vertices(space));
}

std::vector<std::int32_t> vertex_ranks(const FlowSpace& space, linear::Communicator communicator) {
  const int size = communicator.size();
  const Rows cells = cells_around_vertices(space);
  std::vector<std::int32_t> rank = groups_of(space, cells);
  const linear::WeightedGraph graph = group_graph(space, cells, rank);
  if (graph.num_vertices() < size)
    reject_input("{} ranks are too many for {} vertices", size, space.num_vertices());
  std::vector<std::int32_t> part(at(graph.num_vertices()));
  if (communicator.rank() == 0) part = linear::partition(graph, size);
  linear::broadcast(communicator, part);
  for (std::int32_t r = 0; r < size; ++r)
    if (std::ranges::find(part, r) == part.end())
      reject_input("{} ranks are too many for {} vertices", size, space.num_vertices());
  for (std::int32_t& of_vertex : rank) of_vertex = part[at(of_vertex)];
  return rank;
}

}  // namespace meniscus::fem
