#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/evolve/record.hpp"
#include "meniscus/io/table.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// A column of a table: its name, its unit as docs/notation.md writes it, and its value in a row.
template <class Row>
struct Column {
  const char *name, *unit;
  io::Cell (*value)(const Row&);
};

/// A row of a table with its step.
template <class Row>
struct RowAtStep {
  std::int64_t step;
  double t;
  const Row& row;
};

/// The columns of history.csv, drops.csv and events.csv, in their order.
[[nodiscard]] std::span<const Column<HistoryRow>> history_columns();
[[nodiscard]] std::span<const Column<RowAtStep<DropRow>>> drop_columns();
[[nodiscard]] std::span<const Column<RowAtStep<TopologyEvent>>> event_columns();

/// The phases of timing.csv and run.json, in their order.
[[nodiscard]] std::span<const char* const> timed_phases();
/// Seconds by phase.
using PhaseSeconds = std::vector<std::pair<std::string, double>>;
/// The columns of timing.csv: `step`, `t`, then the phases with underscores for blanks.
[[nodiscard]] std::vector<std::string> timing_columns();
[[nodiscard]] std::vector<io::Cell> timing_row(std::int64_t step, double t,
                                               const PhaseSeconds& seconds);

template <class Row>
std::vector<std::string> names_of(std::span<const Column<Row>> columns) {
  std::vector<std::string> names;
  for (const Column<Row>& column : columns) names.emplace_back(column.name);
  return names;
}

template <class Row>
std::vector<io::Cell> cells_of(std::span<const Column<Row>> columns, const Row& row) {
  std::vector<io::Cell> cells;
  for (const Column<Row>& column : columns) cells.push_back(column.value(row));
  return cells;
}

}  // namespace meniscus
