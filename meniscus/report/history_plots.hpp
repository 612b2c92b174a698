#pragma once

#include <span>
#include <string>
#include <vector>

#include "meniscus/report/plot_catalogue.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// A heading and the plots under it.
struct PlotGroup {
  std::string heading;
  std::vector<Plot> plots;
};

/// One plot of a run with its reference, where it has one, and its events.
[[nodiscard]] Plot history_plot(const PlotSpec& spec, const RunData& run);

/// The plots that the tables of a run allow: shape, energy and stress, mesh and solver. A plot
/// whose columns are missing or empty is left out, and so is a group without plots.
[[nodiscard]] std::vector<PlotGroup> history_plots(const RunData& run);

/// The plots of several runs over each other: a run has a colour, a quantity its dash.
[[nodiscard]] std::vector<PlotGroup> overlaid_plots(std::span<const RunData> runs,
                                                    std::span<const std::string> names);

}  // namespace meniscus::report
