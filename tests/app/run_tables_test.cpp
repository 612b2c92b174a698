#include "meniscus/app/run_tables.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

using NamesAndUnits = std::vector<std::pair<std::string, std::string>>;

template <class Row>
NamesAndUnits listed(std::span<const Column<Row>> columns) {
  NamesAndUnits list;
  for (const Column<Row>& column : columns) list.emplace_back(column.name, column.unit);
  return list;
}

/// As the notation and the plots name the columns of bulk scalars: `begin` stands for the name.
template <class Value>
void append(NamesAndUnits& list, std::span<const ScalarColumn<Value>> columns,
            const std::string& begin) {
  for (const ScalarColumn<Value>& column : columns)
    list.emplace_back(begin + column.suffix, column.unit);
}

NamesAndUnits listed_history(const std::string& scalar) {
  NamesAndUnits list = listed(history_columns());
  std::ranges::move(listed(history_inertia_columns()), std::back_inserter(list));
  append(list, history_scalar_columns(), scalar);
  return list;
}

NamesAndUnits listed_drops(const std::string& scalar) {
  NamesAndUnits list = listed(drop_columns());
  std::ranges::move(listed(drop_inertia_columns()), std::back_inserter(list));
  append(list, drop_scalar_columns(), scalar);
  return list;
}

/// The cell of a column by its name.
template <class Columns, class Row>
io::Cell cell_of(const Columns& columns, const Row& row, const std::string& name) {
  for (const auto& column : columns)
    if (name == column.name) return column.value(row);
  ADD_FAILURE() << name;
  return {};
}

/// The items "- `name`, `name` [unit]: meaning" below the heading of a file in docs/notation.md.
NamesAndUnits explained(const std::string& file) {
  const std::string page = test::get(std::filesystem::path(MENISCUS_DOCS) / "notation.md");
  const std::size_t begin = page.find("### `" + file + "`");
  EXPECT_NE(begin, std::string::npos) << file;
  const std::string part = page.substr(begin, page.find("\n##", begin + 3) - begin);
  const std::regex item("\n- (`[^`]+`(?:, `[^`]+`)*)(?: \\[([^\\]]+)\\])?"), name("`([^`]+)`");
  NamesAndUnits list;
  for (std::sregex_iterator at(part.begin(), part.end(), item), end; at != end; ++at) {
    const std::string names = (*at)[1], unit = (*at)[2];
    for (std::sregex_iterator each(names.begin(), names.end(), name); each != end; ++each)
      list.emplace_back((*each)[1], unit);
  }
  return list;
}

TEST(RunTables, AreExplainedColumnByColumnInTheNotation) {
  EXPECT_EQ(explained("history.csv"), listed_history("<name>"));
  EXPECT_EQ(explained("drops.csv"), listed_drops("<name>"));
  NamesAndUnits events = listed(event_columns());
  std::ranges::move(listed(event_inertia_columns()), std::back_inserter(events));
  EXPECT_EQ(explained("events.csv"), events);
  std::vector<std::string> names;
  for (const auto& [name, unit] : explained("timing.csv")) names.push_back(name);
  EXPECT_EQ(names, timing_columns(false));
  names.emplace_back("scalars");  // explained below the list
  EXPECT_EQ(names, timing_columns(true));
}

/// A unit as plots write it: "μ_out G² R0³" is "μG²R₀³".
std::string typeset(std::string unit) {
  for (const auto& [from, to] : {std::pair("_out", ""), std::pair("R0", "R₀"),
                                 std::pair("degrees", "°"), std::pair(" ", "")})
    for (std::size_t at = unit.find(from); at != std::string::npos; at = unit.find(from))
      unit.replace(at, std::string(from).size(), to);
  return unit;
}

/// The catalogue of plots as lines "table.column|unit|title", by node.
std::string listed_plots() {
  const std::string command =
      "node --input-type=module -e \"import {CATALOGUE} from '" MENISCUS_DOCS
      "/../web/src/catalogue.js'; for (const p of CATALOGUE) if (p.derivation !== 'sum') for "
      "(const q "
      "of p.quantities) console.log([p.table + '.' + q.column, p.derivation === 'percent' ? '*' : "
      "p.unit, p.title].join('|'))\" 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

TEST(RunTables, HaveTheColumnsAndUnitsOfEveryPlot) {
  std::map<std::string, std::string> units;  // "drops.D" to ""
  for (const auto& [name, unit] : listed_history("*")) units["history." + name] = unit;
  for (const auto& [name, unit] : listed_drops("*")) units["drops." + name] = unit;
  std::stringstream lines(listed_plots());
  ASSERT_FALSE(lines.str().empty()) << "no node here (Debian: apt install nodejs)";
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find('|'), second = line.find('|', first + 1);
    const auto column = units.find(line.substr(0, first));
    ASSERT_NE(column, units.end()) << line;
    const std::string unit = line.substr(first + 1, second - first - 1);
    if (unit == "*") continue;  // a percentage
    EXPECT_EQ(typeset(column->second), unit) << line;
  }
}

TEST(RunTables, LeaveCellsWithoutMeaningEmpty) {
  HistoryRow history;
  EXPECT_EQ(cell_of(history_columns(), history, "power_residual"), io::Cell());
  EXPECT_EQ(cell_of(history_columns(), history, "N1"), io::Cell());
  history.power_in = 3.0;
  history.dissipation = 1.5;
  history.surface_rate = 1.0;
  history.stress = Vec3(5.0, 3.0, 2.0).asDiagonal();
  EXPECT_EQ(cell_of(history_columns(), history, "power_residual"), io::Cell(0.5));
  EXPECT_EQ(cell_of(history_columns(), history, "N1"), io::Cell(2.0));
  EXPECT_EQ(cell_of(history_columns(), history, "N2"), io::Cell(1.0));

  DropRow drop;
  drop.drop = 4;
  EXPECT_EQ(cell_of(drop_columns(), RowAtStep<DropRow>{2, 0.5, drop}, "parent"), io::Cell());
  TopologyEvent event;
  event.kind = EventKind::coalescence;
  event.parents = {0, 1};
  event.children = {2};
  const RowAtStep<TopologyEvent> at{3, 0.25, event};
  EXPECT_EQ(cell_of(event_columns(), at, "kind"), io::Cell("coalescence"));
  EXPECT_EQ(cell_of(event_columns(), at, "parents"), io::Cell("0;1"));
}

TEST(RunTables, TimingHasAZeroForAPhaseThatTookNoTime) {
  for (const bool has_scalars : {false, true}) {
    const std::vector<io::Cell> row = timing_row(7, 0.5, {{"solve", 2.0}}, has_scalars);
    const std::vector<std::string> columns = timing_columns(has_scalars);
    ASSERT_EQ(row.size(), columns.size());
    for (std::size_t i = 2; i < row.size(); ++i)
      EXPECT_EQ(row[i], io::Cell(columns[i] == "solve" ? 2.0 : 0.0));
  }
}

std::vector<Scalar> heat_and_dye() {
  std::vector<Scalar> scalars(2);
  scalars[0].name = "heat";
  scalars[1].name = "dye";
  scalars[1].is_species = true;
  return scalars;
}

/// What a list has behind the fixed columns.
template <class T, class Row>
std::vector<T> behind(const std::vector<T>& all, std::span<const Column<Row>> fixed) {
  return {all.begin() + std::ssize(fixed), all.end()};
}

TEST(RunTables, HaveColumnsOfEachBulkScalarBehindTheOthers) {
  const std::vector<Scalar> scalars = heat_and_dye();
  EXPECT_EQ(behind(history_names({scalars}), history_columns()),
            (std::vector<std::string>{"heat_total", "heat_boundary_rate", "heat_source_rate",
                                      "heat_min", "heat_max", "dye_total", "dye_boundary_rate",
                                      "dye_source_rate", "dye_min", "dye_max"}));
  EXPECT_EQ(
      behind(drop_names({scalars}), drop_columns()),
      (std::vector<std::string>{"heat_amount", "heat_nusselt", "dye_amount", "dye_sherwood"}));
  EXPECT_EQ(history_names({}), names_of(history_columns()));
  EXPECT_EQ(drop_names({}), names_of(drop_columns()));
}

TEST(RunTables, HaveTheCellsOfEachBulkScalar) {
  const std::vector<Scalar> scalars = heat_and_dye();
  HistoryRow history;
  history.scalars = {{1.0, 2.0, 3.0, 4.0, 5.0}, {6.0, 7.0, 8.0, 9.0, 10.0}};
  std::vector<io::Cell> numbers;
  for (int i = 1; i <= 10; ++i) numbers.emplace_back(static_cast<double>(i));
  EXPECT_EQ(behind(history_cells(history, {scalars}), history_columns()), numbers);

  DropRow drop;
  drop.scalars = {{1.0, 2.0}, {3.0, {}}};
  EXPECT_EQ(behind(drop_cells({2, 0.5, drop}, {scalars}), drop_columns()),
            (std::vector<io::Cell>{1.0, 2.0, 3.0, {}}));
  drop.scalars.clear();
  EXPECT_EQ(drop_cells({2, 0.5, drop}, {}),
            cells_of(drop_columns(), RowAtStep<DropRow>{2, 0.5, drop}));
}

TEST(RunTables, HaveColumnsOfInertiaWhereLiquidsHaveSome) {
  const RunPhysics physics{{}, true};
  EXPECT_EQ(behind(history_names(physics), history_columns()),
            (std::vector<std::string>{"kinetic_energy", "kinetic_rate", "transfer_momentum_lost",
                                      "transfer_energy_lost"}));
  EXPECT_EQ(behind(drop_names(physics), drop_columns()),
            (std::vector<std::string>{"velocity_x", "velocity_y", "velocity_z", "reynolds",
                                      "kinetic_energy", "sphericity"}));
  HistoryRow history;
  history.power_in = 10.0;
  history.dissipation = 4.0;
  history.surface_rate = 3.0;
  history.kinetic = KineticTotals{1.0, 2.0, 0.25, 0.5};
  EXPECT_EQ(behind(history_cells(history, physics), history_columns()),
            (std::vector<io::Cell>{1.0, 2.0, 0.25, 0.5}));
  EXPECT_EQ(cell_of(history_columns(), history, "power_residual"), io::Cell(1.0));
  DropRow drop;
  drop.motion = DropMotion{Vec3(1.0, 2.0, 3.0), 4.0, 5.0, 6.0};
  EXPECT_EQ(behind(drop_cells({2, 0.5, drop}, physics), drop_columns()),
            (std::vector<io::Cell>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
  drop.motion.reset();
  EXPECT_EQ(behind(drop_cells({2, 0.5, drop}, physics), drop_columns()), std::vector<io::Cell>(6));
}

}  // namespace
}  // namespace meniscus
