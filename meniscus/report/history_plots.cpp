#include "meniscus/report/history_plots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace meniscus::report {
namespace {

constexpr const char* time_label = "time t [1/G]";
constexpr std::size_t most_drops_in_legend = 6;  // as many as there are colours

/// Columns of a table by name; a column that is not there has no values.
class Columns {
 public:
  explicit Columns(const std::optional<io::Table>& table) : table_(table) {}

  [[nodiscard]] std::vector<double> operator[](const std::string& name) const {
    return table_ && table_->find(name) ? table_->column(name) : std::vector<double>();
  }
  /// Whether there is a number in the column.
  [[nodiscard]] bool has(const std::string& name) const {
    return std::ranges::any_of((*this)[name], [](double v) { return std::isfinite(v); });
  }

 private:
  const std::optional<io::Table>& table_;
};

struct Quantity {
  const char* column;
  const char* label;
};

Plot time_plot(std::string title, std::string unit) {
  return {.title = std::move(title), .unit = std::move(unit), .x_label = time_label};
}

/// Curves of columns of one table against its time.
Plot column_plot(Plot plot, const Columns& columns, const std::vector<Quantity>& quantities) {
  for (const auto& [column, label] : quantities) {
    if (!columns.has(column)) continue;
    plot.curves.push_back({.label = quantities.size() > 1 ? label : "",
                           .x = columns["t"],
                           .y = columns[column],
                           .color = static_cast<int>(plot.curves.size())});
  }
  return plot;
}

/// Rows of drops.csv by the id of their drop.
std::map<int, std::vector<std::size_t>> rows_of_drops(const Columns& drops) {
  std::map<int, std::vector<std::size_t>> rows;
  const std::vector<double> ids = drops["drop"];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (std::isfinite(ids[i])) rows[static_cast<int>(ids[i])].push_back(i);
  }
  return rows;
}

/// Curves of columns of drops.csv, one for each drop and quantity: with one drop the quantities
/// have the colours, with several the drops have them and the quantities their dashes.
Plot drop_plot(Plot plot, const Columns& drops, const std::vector<Quantity>& quantities) {
  const auto rows = rows_of_drops(drops);
  const bool is_single = rows.size() == 1;
  const std::vector<double> t = drops["t"];
  if (!is_single && quantities.size() == 3) {
    plot.title += fmt::format(": {} solid, {} dashed, {} dotted", quantities[0].label,
                              quantities[1].label, quantities[2].label);
  }
  for (const auto& [drop, of_drop] : rows) {
    const auto rank = static_cast<std::size_t>(std::distance(rows.begin(), rows.find(drop)));
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      if (!drops.has(quantities[q].column)) continue;
      const std::vector<double> values = drops[quantities[q].column];
      Curve curve{.color = static_cast<int>(is_single ? q : rank),
                  .dash = is_single ? 0 : static_cast<int>(q)};
      for (const std::size_t row : of_drop) {
        curve.x.push_back(t[row]);
        curve.y.push_back(values[row]);
      }
      if (is_single && quantities.size() > 1) curve.label = quantities[q].label;
      if (!is_single && q == 0 && rank < most_drops_in_legend) {
        curve.label = fmt::format("drop {}", drop);
      }
      plot.curves.push_back(std::move(curve));
    }
  }
  return plot;
}

/// Share of the power that the balance leaves over, in per cent.
Plot residual_plot(const Columns& history) {
  Plot plot = time_plot("Energy residual over power in", "%");
  const std::vector<double> residual = history["power_residual"], power = history["power_in"];
  if (!history.has("power_residual") || residual.size() != power.size()) return plot;
  Curve curve{.x = history["t"]};
  for (std::size_t i = 0; i < power.size(); ++i) {
    curve.y.push_back(100.0 * residual[i] / std::abs(power[i]));
  }
  plot.curves.push_back(std::move(curve));
  plot.includes_zero = true;
  return plot;
}

/// Seconds of wall time from one row of timing.csv to the next.
Plot step_time_plot(const RunData& run) {
  Plot plot = time_plot("Wall time per step", "s");
  if (!run.timing) return plot;
  const Columns timing(run.timing);
  Curve curve{.x = timing["t"]};
  curve.y.assign(curve.x.size(), 0.0);
  for (const std::string& column : run.timing->columns) {
    if (column == "step" || column == "t") continue;
    const std::vector<double> seconds = timing[column];
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      if (std::isfinite(seconds[i])) curve.y[i] += seconds[i];
    }
  }
  if (!curve.x.empty()) plot.curves.push_back(std::move(curve));
  plot.includes_zero = true;
  return plot;
}

std::vector<Mark> event_marks(const RunData& run) {
  std::vector<Mark> marks;
  if (!run.events || !run.events->find("t") || !run.events->find("kind")) return marks;
  const std::vector<double> t = run.events->column("t");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::string& kind = run.events->rows[i][*run.events->find("kind")];
    marks.push_back({t[i], fmt::format("{} at t = {:.4g}", kind, t[i])});
  }
  return marks;
}

PlotGroup shape_group(const Columns& drops) {
  Plot deformation = time_plot("Deformation D = (L − B)/(L + B)", "");
  deformation.includes_zero = true;
  Plot drift = time_plot("Volume drift V/V₀ − 1", "");
  drift.includes_zero = true;
  return {"Shape",
          {drop_plot(deformation, drops, {{"D", "D"}}),
           drop_plot(time_plot("Half lengths", "R₀"), drops, {{"L", "L"}, {"B", "B"}, {"W", "W"}}),
           drop_plot(time_plot("Inclination of L to the flow", "°"), drops, {{"angle_deg", "θ"}}),
           drop_plot(time_plot("Largest mean curvature H", "1/R₀"), drops, {{"H_max", "H"}}),
           drop_plot(drift, drops, {{"volume_drift", "V/V₀ − 1"}}),
           drop_plot(time_plot("Shift that restores the volume", "R₀"), drops,
                     {{"volume_correction", "shift"}})}};
}

PlotGroup energy_group(const Columns& history) {
  return {"Energy and stress",
          {column_plot(time_plot("Power", "μG²R₀³"), history,
                       {{"power_in", "power in"},
                        {"dissipation", "dissipation"},
                        {"surface_rate", "rate of surface energy"}}),
           residual_plot(history),
           column_plot(time_plot("Shear stress (xy) added by the drops", "μG"), history,
                       {{"stress_xy", "xy"}}),
           column_plot(time_plot("Normal stress differences added by the drops", "μG"), history,
                       {{"N1", "N₁"}, {"N2", "N₂"}})}};
}

/// The step that led to each row; the first row has none, which its 0 stands for.
Plot time_step_plot(const Columns& history) {
  Plot plot = column_plot(time_plot("Time step Δt", "1/G"), history, {{"dt", "Δt"}});
  for (Curve& curve : plot.curves) {
    std::ranges::replace(curve.y, 0.0, std::numeric_limits<double>::quiet_NaN());
  }
  return plot;
}

PlotGroup mesh_group(const RunData& run, const Columns& history) {
  Plot counts = time_plot("Size of the meshes", "");
  counts.is_log = true;
  Plot angle = time_plot("Smallest dihedral angle", "°");
  angle.includes_zero = true;
  Plot iterations = time_plot("Linear iterations per step", "");
  iterations.includes_zero = true;
  Plot gap = time_plot("Smallest gap", "R₀");
  gap.is_log = true;
  return {
      "Mesh and solver",
      {column_plot(
           counts, history,
           {{"surface_nodes", "surface nodes"}, {"nodes", "nodes"}, {"tetrahedra", "tetrahedra"}}),
       time_step_plot(history),
       column_plot(iterations, history, {{"linear_iterations", "iterations"}}),
       column_plot(angle, history, {{"min_dihedral_deg", "angle"}}),
       column_plot(gap, history, {{"min_gap", "gap"}}), step_time_plot(run)}};
}

bool is_drawable(const Plot& plot) {
  return std::ranges::any_of(plot.curves, [](const Curve& curve) {
    return std::ranges::any_of(curve.y, [](double v) { return std::isfinite(v); });
  });
}

}  // namespace

std::vector<PlotGroup> history_plots(const RunData& run) {
  const Columns history(run.history), drops(run.drops);
  std::vector<PlotGroup> groups = {shape_group(drops), energy_group(history),
                                   mesh_group(run, history)};
  const std::vector<Mark> marks = event_marks(run);
  for (PlotGroup& group : groups) {
    std::erase_if(group.plots, [](const Plot& plot) { return !is_drawable(plot); });
    for (Plot& plot : group.plots) plot.marks = marks;
  }
  std::erase_if(groups, [](const PlotGroup& group) { return group.plots.empty(); });
  return groups;
}

}  // namespace meniscus::report
