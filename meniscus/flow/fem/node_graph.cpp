#include "meniscus/flow/fem/node_graph.hpp"

#include <algorithm>
#include <limits>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/index.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// For each node the places in `cell_nodes` that name it.
struct Incidence {
  std::vector<std::int32_t> first, place;
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

/// Appends the columns of one row, in rising order: the nodes of the cells of `places`. `index_of`
/// holds the latest place of each node in `row_columns`, -1 where it has none.
void append_row(const NodeTable& rows, const NodeTable& columns,
                std::span<const std::int32_t> places, std::vector<std::int32_t>& index_of,
                std::vector<std::int32_t>& row_columns) {
  const auto start = static_cast<std::int32_t>(row_columns.size());
  for (const std::int32_t place : places)
    for (const std::int32_t j : columns.of(CellId{place / rows.nodes_per_cell})) {
      if (index_of[at(j)] >= start) continue;  // already in this row
      index_of[at(j)] = start;
      row_columns.push_back(j);
    }
  std::sort(row_columns.begin() + start, row_columns.end());
  const std::int32_t end =
      linear::checked_index(std::ssize(row_columns), "pairs of neighbouring nodes");
  MENISCUS_ASSERT(end - start <= std::numeric_limits<std::uint16_t>::max(), "{}", end - start);
  for (std::int32_t k = start; k < end; ++k) index_of[at(row_columns[at(k)])] = k;
}

}  // namespace

NodeGraph node_graph(const NodeTable& rows, const NodeTable& columns) {
  MENISCUS_ASSERT(rows.num_cells() == columns.num_cells(), "{} {}", rows.num_cells(),
                  columns.num_cells());
  const Incidence around = incidence(rows);
  const std::int32_t width = columns.nodes_per_cell;
  NodeGraph graph;
  graph.num_columns = columns.num_nodes;
  graph.row_start.reserve(at(rows.num_nodes) + 1);
  graph.row_start.push_back(0);
  graph.columns.reserve(at(rows.num_nodes) * 16);  // about 15 neighbours and itself
  graph.position.resize(rows.cell_nodes.size() * at(width));
  std::vector<std::int32_t> index_of(at(columns.num_nodes), -1);
  for (std::int32_t i = 0; i < rows.num_nodes; ++i) {
    const std::int32_t start = graph.row_start.back();
    const std::span<const std::int32_t> places =
        std::span(around.place)
            .subspan(at(around.first[at(i)]), at(around.first[at(i) + 1] - around.first[at(i)]));
    append_row(rows, columns, places, index_of, graph.columns);
    const auto end = static_cast<std::int32_t>(graph.columns.size());
    for (const std::int32_t place : places) {
      std::size_t b = at(place) * at(width);
      for (const std::int32_t j : columns.of(CellId{place / rows.nodes_per_cell}))
        graph.position[b++] = static_cast<std::uint16_t>(index_of[at(j)] - start);
    }
    graph.row_start.push_back(end);
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
