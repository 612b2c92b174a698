#include "meniscus/report/plot_catalogue.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace meniscus::report {
namespace {

std::vector<PlotSpec> shape_plots() {
  const std::string group = "Shape";
  return {{.group = group,
           .title = "Deformation D = (L − B)/(L + B)",
           .unit = "",
           .table = "drops",
           .quantities = {{"D", "D"}},
           .includes_zero = true},
          {.group = group,
           .title = "Half lengths",
           .unit = "R₀",
           .table = "drops",
           .quantities = {{"L", "L"}, {"B", "B"}, {"W", "W"}}},
          {.group = group,
           .title = "Inclination of L to the flow",
           .unit = "°",
           .table = "drops",
           .quantities = {{"angle_deg", "θ"}}},
          {.group = group,
           .title = "Largest mean curvature H",
           .unit = "1/R₀",
           .table = "drops",
           .quantities = {{"H_max", "H"}}},
          {.group = group,
           .title = "Volume drift V/V₀ − 1",
           .unit = "",
           .table = "drops",
           .quantities = {{"volume_drift", "V/V₀ − 1"}},
           .includes_zero = true},
          {.group = group,
           .title = "Shift that restores the volume",
           .unit = "R₀",
           .table = "drops",
           .quantities = {{"volume_correction", "shift"}}}};
}

std::vector<PlotSpec> surfactant_plots() {
  const std::string group = "Surfactant";
  return {{.group = group,
           .title = "Concentration Γ over the initial one",
           .unit = "",
           .table = "drops",
           .quantities = {{"surfactant_min", "least"}, {"surfactant_max", "largest"}}},
          {.group = group,
           .title = "Least tension over that at Γ = 1",
           .unit = "",
           .table = "drops",
           .quantities = {{"tension_min", "σ/σ₁"}}}};
}

std::vector<PlotSpec> scalar_plots() {
  const std::string group = "Temperature and species";
  return {{.group = group,
           .title = "*: amount",
           .unit = "R₀³",
           .table = "history",
           .quantities = {{"*_total", "amount"}}},
          {.group = group,
           .title = "*: amount in the drops",
           .unit = "R₀³",
           .table = "drops",
           .quantities = {{"*_amount", "amount"}}},
          {.group = group,
           .title = "*: amount gained per time",
           .unit = "R₀³G",
           .table = "history",
           .quantities = {{"*_boundary_rate", "through the boundary"},
                          {"*_source_rate", "from sources"}}},
          {.group = group,
           .title = "*: range",
           .unit = "",
           .table = "history",
           .quantities = {{"*_min", "least"}, {"*_max", "largest"}}},
          {.group = group,
           .title = "*: Nusselt number",
           .unit = "",
           .table = "drops",
           .quantities = {{"*_nusselt", "Nu"}}},
          {.group = group,
           .title = "*: Sherwood number",
           .unit = "",
           .table = "drops",
           .quantities = {{"*_sherwood", "Sh"}}}};
}

std::vector<PlotSpec> inertia_plots() {
  const std::string group = "Inertia";
  return {{.group = group,
           .title = "Velocity of the drop, the mean over its volume",
           .unit = "GR₀",
           .table = "drops",
           .quantities = {{"velocity_x", "v_x"}, {"velocity_y", "v_y"}, {"velocity_z", "v_z"}},
           .includes_zero = true},
          {.group = group,
           .title = "Reynolds number of the drop's motion",
           .unit = "",
           .table = "drops",
           .quantities = {{"reynolds", "Re"}}},
          {.group = group,
           .title = "Sphericity",
           .unit = "",
           .table = "drops",
           .quantities = {{"sphericity", "area of the sphere over its own"}}},
          {.group = group,
           .title = "Kinetic energy of all liquids",
           .unit = "μGR₀³",
           .table = "history",
           .quantities = {{"kinetic_energy", "energy"}},
           .includes_zero = true}};
}

std::vector<PlotSpec> energy_plots() {
  const std::string group = "Energy and stress";
  return {{.group = group,
           .title = "Power",
           .unit = "μG²R₀³",
           .table = "history",
           .quantities = {{"power_in", "power in"},
                          {"dissipation", "dissipation"},
                          {"surface_rate", "rate of surface energy"},
                          {"kinetic_rate", "rate of kinetic energy"}}},
          {.group = group,
           .title = "Energy residual over power in",
           .unit = "%",
           .table = "history",
           .quantities = {{"power_residual", "residual"}, {"power_in", "power in"}},
           .includes_zero = true,
           .derivation = Derivation::percent},
          {.group = group,
           .title = "Shear stress (xy) added by the drops",
           .unit = "μG",
           .table = "history",
           .quantities = {{"stress_xy", "xy"}}},
          {.group = group,
           .title = "Normal stress differences added by the drops",
           .unit = "μG",
           .table = "history",
           .quantities = {{"N1", "N₁"}, {"N2", "N₂"}}}};
}

std::vector<PlotSpec> mesh_plots() {
  const std::string group = "Mesh and solver";
  return {{.group = group,
           .title = "Size of the meshes",
           .unit = "",
           .table = "history",
           .quantities = {{"surface_nodes", "surface nodes"},
                          {"nodes", "nodes"},
                          {"tetrahedra", "tetrahedra"}},
           .is_log = true},
          {.group = group,
           .title = "Time step Δt",
           .unit = "1/G",
           .table = "history",
           .quantities = {{"dt", "Δt"}},
           .derivation = Derivation::gap_at_zeros},  // no step led to the first row
          {.group = group,
           .title = "Linear iterations per step",
           .unit = "",
           .table = "history",
           .quantities = {{"linear_iterations", "iterations"}},
           .includes_zero = true},
          {.group = group,
           .title = "Smallest dihedral angle",
           .unit = "°",
           .table = "history",
           .quantities = {{"min_dihedral_deg", "angle"}},
           .includes_zero = true},
          {.group = group,
           .title = "Smallest gap",
           .unit = "R₀",
           .table = "history",
           .quantities = {{"min_gap", "gap"}},
           .is_log = true},
          {.group = group,
           .title = "Wall time per step",
           .unit = "s",
           .table = "timing",
           .quantities = {{"", "wall time"}},
           .includes_zero = true,
           .derivation = Derivation::sum}};
}

const char* name_of(Derivation derivation) {
  switch (derivation) {
    case Derivation::percent:
      return "percent";
    case Derivation::sum:
      return "sum";
    case Derivation::gap_at_zeros:
      return "gap-at-zeros";
    default:
      return "none";
  }
}

const io::Table* table_of(const PlotSpec& plot, const RunData& run) {
  const std::optional<io::Table>& table = plot.table == "drops" ? run.drops : run.history;
  return table ? &*table : nullptr;
}

/// The names that `*` stands for in the columns of the runs' tables.
std::vector<std::string> scalar_names(const PlotSpec& plot, std::span<const RunData> runs) {
  const std::string suffix = plot.quantities.front().column.substr(1);
  std::vector<std::string> names;
  for (const RunData& run : runs) {
    const io::Table* table = table_of(plot, run);
    if (table == nullptr) continue;
    for (const std::string& column : table->columns) {
      if (!column.ends_with(suffix)) continue;
      const std::string name = column.substr(0, column.size() - suffix.size());
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::string with_name(const std::string& text, const std::string& name) {
  const std::size_t at = text.find('*');
  return at == std::string::npos ? text : text.substr(0, at) + name + text.substr(at + 1);
}

PlotSpec plot_of_scalar(PlotSpec plot, const std::string& name) {
  plot.title = with_name(plot.title, name);
  for (auto& [column, label] : plot.quantities) {
    column = with_name(column, name);
    label = with_name(label, name);
  }
  return plot;
}

}  // namespace

std::vector<PlotSpec> plots_of(std::span<const RunData> runs) {
  std::vector<PlotSpec> plots;
  for (const PlotSpec& plot : plot_catalogue()) {
    if (!plot.quantities.front().column.starts_with('*')) {
      plots.push_back(plot);
      continue;
    }
    for (const std::string& name : scalar_names(plot, runs))
      plots.push_back(plot_of_scalar(plot, name));
  }
  return plots;
}

std::span<const PlotSpec> plot_catalogue() {
  static const std::vector<PlotSpec> all = [] {
    std::vector<PlotSpec> plots = shape_plots();
    for (const auto& group :
         {surfactant_plots(), inertia_plots(), scalar_plots(), energy_plots(), mesh_plots()}) {
      plots.insert(plots.end(), group.begin(), group.end());
    }
    return plots;
  }();
  return all;
}

std::string plot_catalogue_json() {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const PlotSpec& plot : plot_catalogue()) {
    Json quantities = Json::array();
    for (const auto& [column, label] : plot.quantities) {
      quantities.push_back({{"column", column}, {"label", label}});
    }
    list.push_back({{"group", plot.group},
                    {"title", plot.title},
                    {"unit", plot.unit},
                    {"table", plot.table},
                    {"quantities", quantities},
                    {"log", plot.is_log},
                    {"zero", plot.includes_zero},
                    {"derivation", name_of(plot.derivation)}});
  }
  return list.dump();
}

}  // namespace meniscus::report
