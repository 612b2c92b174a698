#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/evolve/record.hpp"
#include "meniscus/io/table.hpp"
#include "meniscus/scene/scene.hpp"
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

/// A column that a table has once for each bulk scalar, or for each of one kind. It has what
/// follows the scalar's name, its unit, and its value.
template <class Value>
struct ScalarColumn {
  enum class Of { every, heat, species } of;
  const char *suffix, *unit;
  io::Cell (*value)(const Value&);

  [[nodiscard]] bool is_of(const Scalar& scalar) const {
    return of == Of::every || (of == Of::species) == scalar.is_species;
  }
};

/// The columns of history.csv, drops.csv and events.csv, in their order; those of inertia and
/// of bulk scalars follow.
[[nodiscard]] std::span<const Column<HistoryRow>> history_columns();
[[nodiscard]] std::span<const Column<RowAtStep<DropRow>>> drop_columns();
[[nodiscard]] std::span<const Column<RowAtStep<TopologyEvent>>> event_columns();

/// What the liquids of a run have beyond viscosity, which its tables have columns for.
struct RunPhysics {
  std::vector<Scalar> scalars;
  bool has_inertia = false;
};
[[nodiscard]] RunPhysics physics_of(const Scene& scene);

/// Those of liquids with inertia, behind the columns above.
[[nodiscard]] std::span<const Column<HistoryRow>> history_inertia_columns();
[[nodiscard]] std::span<const Column<RowAtStep<DropRow>>> drop_inertia_columns();
[[nodiscard]] std::span<const Column<KineticTotals>> event_inertia_columns();
[[nodiscard]] std::span<const ScalarColumn<ScalarTotals>> history_scalar_columns();
[[nodiscard]] std::span<const ScalarColumn<ScalarOnDrop>> drop_scalar_columns();

/// The columns of history.csv, drops.csv and events.csv in a run. First are the fixed ones, those
/// of inertia where there is any, then all of the first scalar, of the second, ….
[[nodiscard]] std::vector<std::string> history_names(const RunPhysics& physics);
[[nodiscard]] std::vector<std::string> drop_names(const RunPhysics& physics);
[[nodiscard]] std::vector<std::string> event_names(const RunPhysics& physics);
[[nodiscard]] std::vector<io::Cell> history_cells(const HistoryRow& row, const RunPhysics& physics);
[[nodiscard]] std::vector<io::Cell> drop_cells(const RowAtStep<DropRow>& row,
                                               const RunPhysics& physics);
/// `kinetic` is that of the event's step; none without inertia.
[[nodiscard]] std::vector<io::Cell> event_cells(const RowAtStep<TopologyEvent>& row,
                                                const std::optional<KineticTotals>& kinetic);

/// The phases of timing.csv and run.json, in their order; one more in runs with bulk scalars.
[[nodiscard]] std::span<const char* const> timed_phases(bool has_scalars);
/// Seconds by phase.
using PhaseSeconds = std::vector<std::pair<std::string, double>>;
/// The columns of timing.csv: `step`, `t`, then the phases with underscores for blanks.
[[nodiscard]] std::vector<std::string> timing_columns(bool has_scalars);
[[nodiscard]] std::vector<io::Cell> timing_row(std::int64_t step, double t,
                                               const PhaseSeconds& seconds, bool has_scalars);

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
