#include "meniscus/report/history_plots.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/history_curves.hpp"

namespace meniscus::report {
namespace {

constexpr std::size_t most_drops_in_legend = 6;  // the number of colours

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

Plot empty_plot(const PlotSpec& spec) {
  Plot plot{.title = spec.title, .unit = spec.unit, .x_label = "time t [1/G]"};
  plot.is_log = spec.is_log;
  plot.includes_zero = spec.includes_zero;
  return plot;
}

/// Adds curves to a plot. With one drop or none, colours tell quantities apart. With several drops,
/// colours tell drops and dashes quantities apart.
void add_curves(Plot& plot, const PlotSpec& spec, const std::vector<HistoryCurve>& curves) {
  for ([[maybe_unused]] const HistoryCurve& curve : curves)
    MENISCUS_ASSERT(curve.t.size() == curve.values.size(), "{} times of {} values", curve.t.size(),
                    curve.values.size());
  std::set<int> drops;
  for (const HistoryCurve& curve : curves) drops.insert(curve.drop);
  const bool is_single = drops.size() <= 1;
  const bool has_quantities = spec.quantities.size() > 1 && spec.derivation != Derivation::percent;
  if (!is_single && spec.quantities.size() == 3) {
    plot.title += fmt::format(": {} solid, {} dashed, {} dotted", spec.quantities[0].label,
                              spec.quantities[1].label, spec.quantities[2].label);
  }
  for (const HistoryCurve& history : curves) {
    const auto rank =
        static_cast<std::size_t>(std::distance(drops.begin(), drops.find(history.drop)));
    Curve curve{.x = history.t, .y = history.values};
    curve.color = static_cast<int>(is_single ? history.quantity : rank);
    curve.dash = is_single ? 0 : static_cast<int>(history.quantity);
    if (is_single && has_quantities) curve.label = spec.quantities[history.quantity].label;
    if (!is_single && history.quantity == 0 && rank < most_drops_in_legend) {
      curve.label = fmt::format("drop {}", history.drop);
    }
    plot.curves.push_back(std::move(curve));
  }
}

/// Adds the reference of the case, in the colour of the text.
void add_reference(Plot& plot, const PlotSpec& spec, const RunData& run) {
  bool is_first = true;
  for (const HistoryCurve& reference : reference_curves(spec, run)) {
    plot.curves.push_back({.label = is_first ? "reference" : "",
                           .x = reference.t,
                           .y = reference.values,
                           .dash = 2,
                           .stroke = "#7d8792"});
    is_first = false;
  }
}

bool is_drawable(const Plot& plot) {
  return std::ranges::any_of(plot.curves, [](const Curve& curve) {
    return std::ranges::any_of(curve.y, [](double v) { return std::isfinite(v); });
  });
}

Plot overlaid_plot(const PlotSpec& spec, std::span<const RunData> runs,
                   std::span<const std::string> names) {
  Plot plot = empty_plot(spec);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    bool is_first = true;
    for (const HistoryCurve& history : history_curves(spec, runs[i])) {
      plot.curves.push_back({.label = is_first ? names[i] : "",
                             .x = history.t,
                             .y = history.values,
                             .color = static_cast<int>(i),
                             .dash = static_cast<int>(history.quantity)});
      is_first = false;
    }
  }
  return plot;
}

std::vector<PlotGroup> plot_groups(std::span<std::pair<std::string, Plot>> plots) {
  std::vector<PlotGroup> groups;
  for (auto& [group, plot] : plots) {
    if (!is_drawable(plot)) continue;
    if (groups.empty() || groups.back().heading != group) groups.push_back({group, {}});
    groups.back().plots.push_back(std::move(plot));
  }
  return groups;
}

}  // namespace

Plot history_plot(const PlotSpec& spec, const RunData& run) {
  Plot plot = empty_plot(spec);
  const std::vector<HistoryCurve> curves = history_curves(spec, run);
  add_curves(plot, spec, curves);
  if (!curves.empty()) add_reference(plot, spec, run);
  plot.marks = event_marks(run);
  return plot;
}

std::vector<PlotGroup> history_plots(const RunData& run) {
  std::vector<std::pair<std::string, Plot>> plots;
  for (const PlotSpec& spec : plots_of(std::span(&run, 1)))
    plots.emplace_back(spec.group, history_plot(spec, run));
  return plot_groups(plots);
}

std::vector<PlotGroup> overlaid_plots(std::span<const RunData> runs,
                                      std::span<const std::string> names) {
  std::vector<std::pair<std::string, Plot>> plots;
  for (const PlotSpec& spec : plots_of(runs)) {
    plots.emplace_back(spec.group, overlaid_plot(spec, runs, names));
  }
  return plot_groups(plots);
}

}  // namespace meniscus::report
