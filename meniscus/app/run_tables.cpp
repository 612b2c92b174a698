// The columns of a run's tables: what docs/notation.md explains and what checks and plots name.
#include "meniscus/app/run_tables.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using io::Cell;
using Drop = RowAtStep<DropRow>;
using Event = RowAtStep<TopologyEvent>;

template <class T>
Cell cell(const std::optional<T>& value) {
  return value ? Cell(*value) : Cell();
}

Cell id_list(const std::vector<int>& ids) { return fmt::format("{}", fmt::join(ids, ";")); }

template <int I, int J>
Cell stress(const HistoryRow& h) {
  return h.stress ? Cell((*h.stress)(I, J)) : Cell();
}
/// The normal-stress difference Σ_II − Σ_JJ.
template <int I, int J>
Cell difference(const HistoryRow& h) {
  return h.stress ? Cell((*h.stress)(I, I) - (*h.stress)(J, J)) : Cell();
}

/// The words of StepBound, in its order.
constexpr std::array kBounds{"step-factor", "error",   "stability", "slip", "displacement",
                             "neck",        "growth",  "beginning", "jump", "max-step",
                             "min-step",    "refusal", "convection"};
std::string word_for(StepBound bound) { return kBounds.at(static_cast<std::size_t>(bound)); }

constexpr const char *kPower = "μ_out G² R0³", *kStress = "μ_out G", *kEnergy = "μ_out G R0³";

constexpr std::array<Column<HistoryRow>, 25> kHistory{{
    {"step", "", [](const HistoryRow& h) { return Cell(h.step); }},
    {"t", "1/G", [](const HistoryRow& h) { return Cell(h.t); }},
    {"dt", "1/G", [](const HistoryRow& h) { return Cell(h.dt); }},
    {"drops", "", [](const HistoryRow& h) { return Cell(std::int64_t{h.drops}); }},
    {"surface_nodes", "", [](const HistoryRow& h) { return Cell(h.surface_nodes); }},
    {"nodes", "", [](const HistoryRow& h) { return cell(h.nodes); }},
    {"tetrahedra", "", [](const HistoryRow& h) { return cell(h.tetrahedra); }},
    {"min_gap", "R0", [](const HistoryRow& h) { return cell(h.min_gap); }},
    {"min_dihedral_deg", "degrees", [](const HistoryRow& h) { return cell(h.min_dihedral_deg); }},
    {"linear_iterations", "",
     [](const HistoryRow& h) { return Cell(std::int64_t{h.linear_iterations}); }},
    {"power_in", kPower, [](const HistoryRow& h) { return cell(h.power_in); }},
    {"dissipation", kPower, [](const HistoryRow& h) { return cell(h.dissipation); }},
    {"surface_rate", kPower, [](const HistoryRow& h) { return Cell(h.surface_rate); }},
    {"power_residual", kPower, [](const HistoryRow& h) { return cell(h.power_residual()); }},
    {"stress_xx", kStress, stress<0, 0>},
    {"stress_yy", kStress, stress<1, 1>},
    {"stress_zz", kStress, stress<2, 2>},
    {"stress_xy", kStress, stress<0, 1>},
    {"stress_xz", kStress, stress<0, 2>},
    {"stress_yz", kStress, stress<1, 2>},
    {"N1", kStress, difference<0, 1>},
    {"N2", kStress, difference<1, 2>},
    {"step_error", "", [](const HistoryRow& h) { return cell(h.step_error); }},
    {"step_bound", "",
     [](const HistoryRow& h) { return h.step_bound ? Cell(word_for(*h.step_bound)) : Cell(); }},
    {"mesh_kept", "",
     [](const HistoryRow& h) {
       return h.is_mesh_kept ? Cell(std::int64_t{*h.is_mesh_kept ? 1 : 0}) : Cell();
     }},
}};

template <double SurfactantSpread::*Member>
Cell surfactant(const Drop& d) {
  return d.row.surfactant ? Cell((*d.row.surfactant).*Member) : Cell();
}

constexpr std::array<Column<Drop>, 24> kDrops{{
    {"step", "", [](const Drop& d) { return Cell(d.step); }},
    {"t", "1/G", [](const Drop& d) { return Cell(d.t); }},
    {"drop", "", [](const Drop& d) { return Cell(std::int64_t{d.row.drop}); }},
    {"parent", "",
     [](const Drop& d) { return d.row.parent < 0 ? Cell() : Cell(std::int64_t{d.row.parent}); }},
    {"volume", "R0³", [](const Drop& d) { return Cell(d.row.shape.volume); }},
    {"volume_drift", "", [](const Drop& d) { return Cell(d.row.volume_drift); }},
    {"volume_correction", "R0", [](const Drop& d) { return Cell(d.row.volume_correction); }},
    {"area", "R0²", [](const Drop& d) { return Cell(d.row.shape.area); }},
    {"x", "R0", [](const Drop& d) { return Cell(d.row.shape.centroid.x()); }},
    {"y", "R0", [](const Drop& d) { return Cell(d.row.shape.centroid.y()); }},
    {"z", "R0", [](const Drop& d) { return Cell(d.row.shape.centroid.z()); }},
    {"L", "R0", [](const Drop& d) { return Cell(d.row.shape.L); }},
    {"B", "R0", [](const Drop& d) { return Cell(d.row.shape.B); }},
    {"W", "R0", [](const Drop& d) { return Cell(d.row.shape.W); }},
    {"D", "", [](const Drop& d) { return Cell(d.row.shape.D); }},
    {"angle_deg", "degrees", [](const Drop& d) { return cell(d.row.shape.angle_deg); }},
    {"extent_x", "R0", [](const Drop& d) { return Cell(d.row.shape.extent_x); }},
    {"H_max", "1/R0", [](const Drop& d) { return Cell(d.row.shape.H_max); }},
    {"D_inertia", "", [](const Drop& d) { return Cell(d.row.shape.D_inertia); }},
    {"neck_radius", "R0", [](const Drop& d) { return cell(d.row.neck_radius); }},
    {"surfactant", "R0²", surfactant<&SurfactantSpread::amount>},
    {"surfactant_min", "", surfactant<&SurfactantSpread::least>},
    {"surfactant_max", "", surfactant<&SurfactantSpread::most>},
    {"tension_min", "", surfactant<&SurfactantSpread::least_tension>},
}};

constexpr std::array<Column<Event>, 16> kEvents{{
    {"step", "", [](const Event& e) { return Cell(e.step); }},
    {"t", "1/G", [](const Event& e) { return Cell(e.t); }},
    {"kind", "",
     [](const Event& e) {
       return Cell(e.row.kind == EventKind::breakup ? "breakup" : "coalescence");
     }},
    {"x", "R0", [](const Event& e) { return Cell(e.row.position.x()); }},
    {"y", "R0", [](const Event& e) { return Cell(e.row.position.y()); }},
    {"z", "R0", [](const Event& e) { return Cell(e.row.position.z()); }},
    {"parents", "", [](const Event& e) { return id_list(e.row.parents); }},
    {"children", "", [](const Event& e) { return id_list(e.row.children); }},
    {"volume_before", "R0³", [](const Event& e) { return Cell(e.row.volume_before); }},
    {"volume_after", "R0³", [](const Event& e) { return Cell(e.row.volume_after); }},
    {"area_before", "R0²", [](const Event& e) { return Cell(e.row.area_before); }},
    {"area_after", "R0²", [](const Event& e) { return Cell(e.row.area_after); }},
    {"energy_before", kEnergy, [](const Event& e) { return Cell(e.row.energy_before); }},
    {"energy_after", kEnergy, [](const Event& e) { return Cell(e.row.energy_after); }},
    {"neck_radius", "R0", [](const Event& e) { return cell(e.row.neck_radius); }},
    {"gap", "R0", [](const Event& e) { return cell(e.row.gap); }},
}};

template <double KineticTotals::*Member>
Cell kinetic(const HistoryRow& h) {
  return h.kinetic ? Cell((*h.kinetic).*Member) : Cell();
}
constexpr std::array<Column<HistoryRow>, 4> kHistoryOfInertia{{
    {"kinetic_energy", kEnergy, kinetic<&KineticTotals::energy>},
    {"kinetic_rate", kPower, kinetic<&KineticTotals::rate>},
    {"transfer_momentum_lost", "", kinetic<&KineticTotals::momentum_lost>},
    {"transfer_energy_lost", kEnergy, kinetic<&KineticTotals::energy_lost>},
}};

constexpr std::array<Column<KineticTotals>, 1> kEventsOfInertia{{
    {"kinetic_energy_lost", kEnergy, [](const KineticTotals& k) { return Cell(k.energy_lost); }},
}};

template <int I>
Cell velocity(const Drop& d) {
  return d.row.motion ? Cell(d.row.motion->velocity[I]) : Cell();
}
template <double DropMotion::*Member>
Cell motion(const Drop& d) {
  return d.row.motion ? Cell((*d.row.motion).*Member) : Cell();
}
constexpr std::array<Column<Drop>, 6> kDropsOfInertia{{
    {"velocity_x", "G R0", velocity<0>},
    {"velocity_y", "G R0", velocity<1>},
    {"velocity_z", "G R0", velocity<2>},
    {"reynolds", "", motion<&DropMotion::reynolds>},
    {"kinetic_energy", kEnergy, motion<&DropMotion::kinetic_energy>},
    {"sphericity", "", motion<&DropMotion::sphericity>},
}};

using OfAll = ScalarColumn<ScalarTotals>::Of;
constexpr std::array<ScalarColumn<ScalarTotals>, 5> kHistoryOfScalars{{
    {OfAll::every, "_total", "R0³", [](const ScalarTotals& s) { return Cell(s.amount); }},
    {OfAll::every, "_boundary_rate", "R0³ G",
     [](const ScalarTotals& s) { return Cell(s.boundary_rate); }},
    {OfAll::every, "_source_rate", "R0³ G",
     [](const ScalarTotals& s) { return Cell(s.source_rate); }},
    {OfAll::every, "_min", "", [](const ScalarTotals& s) { return Cell(s.least); }},
    {OfAll::every, "_max", "", [](const ScalarTotals& s) { return Cell(s.largest); }},
}};

Cell transfer_number(const ScalarOnDrop& s) { return cell(s.transfer_number); }

using OnDrop = ScalarColumn<ScalarOnDrop>::Of;
constexpr std::array<ScalarColumn<ScalarOnDrop>, 3> kDropsOfScalars{{
    {OnDrop::every, "_amount", "R0³", [](const ScalarOnDrop& s) { return Cell(s.amount); }},
    {OnDrop::heat, "_nusselt", "", transfer_number},
    {OnDrop::species, "_sherwood", "", transfer_number},
}};

template <class Value>
void append_names(std::vector<std::string>& names, std::span<const ScalarColumn<Value>> columns,
                  std::span<const Scalar> scalars) {
  for (const Scalar& scalar : scalars)
    for (const ScalarColumn<Value>& column : columns)
      if (column.is_of(scalar)) names.push_back(scalar.name + column.suffix);
}

template <class Value>
void append_cells(std::vector<Cell>& cells, std::span<const ScalarColumn<Value>> columns,
                  std::span<const Scalar> scalars, const std::vector<Value>& values) {
  MENISCUS_ASSERT(values.size() == scalars.size(), "a row of {} scalars where there are {}",
                  values.size(), scalars.size());
  for (std::size_t k = 0; k < scalars.size(); ++k)
    for (const ScalarColumn<Value>& column : columns)
      if (column.is_of(scalars[k])) cells.push_back(column.value(values[k]));
}

/// The last one only where there are bulk scalars.
constexpr std::array kPhases{"remesh surface", "tetrahedralize", "assemble", "solve",
                             "move mesh",      "diagnostics",    "output",   "move interfaces",
                             "topology",       "scalars"};

}  // namespace

std::span<const Column<HistoryRow>> history_columns() { return kHistory; }
std::span<const Column<Drop>> drop_columns() { return kDrops; }
std::span<const Column<Event>> event_columns() { return kEvents; }
std::span<const Column<HistoryRow>> history_inertia_columns() { return kHistoryOfInertia; }
std::span<const Column<Drop>> drop_inertia_columns() { return kDropsOfInertia; }
std::span<const Column<KineticTotals>> event_inertia_columns() { return kEventsOfInertia; }
std::span<const ScalarColumn<ScalarTotals>> history_scalar_columns() { return kHistoryOfScalars; }
std::span<const ScalarColumn<ScalarOnDrop>> drop_scalar_columns() { return kDropsOfScalars; }

RunPhysics physics_of(const Scene& scene) { return {scene.scalars, has_inertia(scene)}; }

std::vector<std::string> history_names(const RunPhysics& physics) {
  std::vector<std::string> names = names_of(history_columns());
  if (physics.has_inertia)
    std::ranges::move(names_of(history_inertia_columns()), std::back_inserter(names));
  append_names(names, history_scalar_columns(), physics.scalars);
  return names;
}

std::vector<std::string> drop_names(const RunPhysics& physics) {
  std::vector<std::string> names = names_of(drop_columns());
  if (physics.has_inertia)
    std::ranges::move(names_of(drop_inertia_columns()), std::back_inserter(names));
  append_names(names, drop_scalar_columns(), physics.scalars);
  return names;
}

std::vector<std::string> event_names(const RunPhysics& physics) {
  std::vector<std::string> names = names_of(event_columns());
  if (physics.has_inertia)
    std::ranges::move(names_of(event_inertia_columns()), std::back_inserter(names));
  return names;
}

std::vector<Cell> history_cells(const HistoryRow& row, const RunPhysics& physics) {
  std::vector<Cell> cells = cells_of(history_columns(), row);
  if (physics.has_inertia)
    std::ranges::move(cells_of(history_inertia_columns(), row), std::back_inserter(cells));
  append_cells(cells, history_scalar_columns(), physics.scalars, row.scalars);
  return cells;
}

std::vector<Cell> drop_cells(const RowAtStep<DropRow>& row, const RunPhysics& physics) {
  std::vector<Cell> cells = cells_of(drop_columns(), row);
  if (physics.has_inertia)
    std::ranges::move(cells_of(drop_inertia_columns(), row), std::back_inserter(cells));
  append_cells(cells, drop_scalar_columns(), physics.scalars, row.row.scalars);
  return cells;
}

std::vector<Cell> event_cells(const RowAtStep<TopologyEvent>& row,
                              const std::optional<KineticTotals>& kinetic) {
  std::vector<Cell> cells = cells_of(event_columns(), row);
  if (kinetic)
    std::ranges::move(cells_of(event_inertia_columns(), *kinetic), std::back_inserter(cells));
  return cells;
}

std::span<const char* const> timed_phases(bool has_scalars) {
  return std::span(kPhases).first(kPhases.size() - (has_scalars ? 0 : 1));
}

std::vector<std::string> timing_columns(bool has_scalars) {
  std::vector<std::string> columns{"step", "t"};
  for (std::string phase : timed_phases(has_scalars)) {
    std::ranges::replace(phase, ' ', '_');
    columns.push_back(std::move(phase));
  }
  return columns;
}

std::vector<Cell> timing_row(std::int64_t step, double t, const PhaseSeconds& seconds,
                             bool has_scalars) {
  const std::span<const char* const> phases = timed_phases(has_scalars);
  for ([[maybe_unused]] const auto& [phase, spent] : seconds)
    MENISCUS_ASSERT(std::ranges::find(phases, phase) != phases.end(), "no column for the phase {}",
                    phase);
  std::vector<Cell> row{step, t};
  for (const std::string phase : phases) {
    const auto found = std::ranges::find(seconds, phase, &PhaseSeconds::value_type::first);
    row.emplace_back(found == seconds.end() ? 0.0 : found->second);
  }
  return row;
}

}  // namespace meniscus
