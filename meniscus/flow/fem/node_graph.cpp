#include "meniscus/flow/fem/node_graph.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/index.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// For each node the places in `cell_nodes` that name it.
struct Incidence {
  std::vector<std::int32_t> first, place;
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t node) const {
    return {place.data() + first[at(node)], place.data() + first[at(node) + 1]};
  }
};

Incidence incidence(const NodeTable& table) {
  (void)linear::checked_index(std::ssize(table.cell_nodes), "corners of cells");
  Incidence result;
  result.first.assign(at(table.num_nodes) + 1, 0);
  for (const std::int32_t node : table.cell_nodes) ++result.first[at(node) + 1];
  for (std::size_t i = 0; i < at(table.num_nodes); ++i) result.first[i + 1] += result.first[i];
  result.place.resize(table.cell_nodes.size());
  std::vector<std::int32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::size_t k = 0; k < table.cell_nodes.size(); ++k)
    result.place[at(next[at(table.cell_nodes[k])]++)] = static_cast<std::int32_t>(k);
  return result;
}

/// Lists of numbers, one after the other: list i ends where list i + 1 starts.
struct Lists {
  std::vector<std::int32_t> start, number;
};

/// The nodes `among` that share a cell with each node `of`, in no order.
Lists neighbours(const NodeTable& of, const Incidence& around, const NodeTable& among) {
  Lists result;
  result.start.reserve(at(of.num_nodes) + 1);
  result.start.push_back(0);
  result.number.reserve(at(of.num_nodes) * 16);  // about 15 neighbours and itself
  std::vector<std::int32_t> seen_from(at(among.num_nodes), -1);
  for (std::int32_t i = 0; i < of.num_nodes; ++i) {
    for (const std::int32_t place : around.of(i))
      for (const std::int32_t j : among.of(CellId{place / of.nodes_per_cell}))
        if (std::exchange(seen_from[at(j)], i) != i) result.number.push_back(j);
    result.start.push_back(
        linear::checked_index(std::ssize(result.number), "pairs of neighbouring nodes"));
  }
  return result;
}

/// The lists of i by j, of `num_lists` j, from those of j by i. They are in rising order.
Lists transposed(const Lists& lists, std::int32_t num_lists) {
  Lists result{std::vector<std::int32_t>(at(num_lists) + 1, 0),
               std::vector<std::int32_t>(lists.number.size())};
  for (const std::int32_t j : lists.number) ++result.start[at(j) + 1];
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  std::vector<std::int32_t> next(result.start.begin(), result.start.end() - 1);
  for (std::int32_t i = 0; i + 1 < std::ssize(lists.start); ++i)
    for (std::int32_t k = lists.start[at(i)]; k < lists.start[at(i) + 1]; ++k)
      result.number[at(next[at(lists.number[at(k)])]++)] = i;
  return result;
}

}  // namespace

NodeGraph node_graph(const NodeTable& rows, const NodeTable& columns) {
  MENISCUS_ASSERT(rows.num_cells() == columns.num_cells(), "{} {}", rows.num_cells(),
                  columns.num_cells());
  const Incidence around = incidence(rows);
  Lists sorted = transposed(&rows == &columns ? neighbours(rows, around, rows)
                                              : neighbours(columns, incidence(columns), rows),
                            rows.num_nodes);
  NodeGraph graph{columns.num_nodes, std::move(sorted.start), std::move(sorted.number), {}};
  const std::int32_t width = columns.nodes_per_cell;
  graph.position.resize(rows.cell_nodes.size() * at(width));
  std::vector<std::uint16_t> index_of(at(columns.num_nodes));
  for (std::int32_t i = 0; i < rows.num_nodes; ++i) {
    const std::int32_t start = graph.row_start[at(i)], end = graph.row_start[at(i) + 1];
    MENISCUS_ASSERT(end - start <= std::numeric_limits<std::uint16_t>::max(), "{}", end - start);
    for (std::int32_t k = start; k < end; ++k)
      index_of[at(graph.columns[at(k)])] = static_cast<std::uint16_t>(k - start);
    for (const std::int32_t place : around.of(i)) {
      std::size_t b = at(place) * at(width);
      for (const std::int32_t j : columns.of(CellId{place / rows.nodes_per_cell}))
        graph.position[b++] = index_of[at(j)];
    }
  }
  return graph;
}

ScalarPattern scalar_pattern(const NodeGraph& graph, std::int32_t block_rows,
                             std::int32_t block_columns) {
  const std::size_t num_entries = graph.num_entries() * at(block_rows) * at(block_columns);
  (void)linear::checked_index(static_cast<std::int64_t>(num_entries), "matrix entries");
  ScalarPattern pattern;
  pattern.row_start.reserve(at(graph.num_rows()) * at(block_rows) + 1);
  pattern.row_start.push_back(0);
  pattern.columns.resize(num_entries);
  std::size_t k = 0;
  for (std::int32_t i = 0; i < graph.num_rows(); ++i)
    for (std::int32_t a = 0; a < block_rows; ++a) {
      for (std::int32_t e = graph.row_start[at(i)]; e < graph.row_start[at(i) + 1]; ++e)
        for (std::int32_t b = 0; b < block_columns; ++b)
          pattern.columns[k++] = graph.columns[at(e)] * block_columns + b;
      pattern.row_start.push_back(static_cast<std::int32_t>(k));
    }
  MENISCUS_ASSERT(k == num_entries, "{} {}", k, num_entries);
  return pattern;
}

}  // namespace meniscus::fem
