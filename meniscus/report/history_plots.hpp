#pragma once

#include <span>
#include <string>
#include <vector>

#include "meniscus/report/plot_catalogue.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// A heading with its plots.
struct PlotGroup {
  std::string heading;
  std::vector<Plot> plots;
};

/// One plot of a run with its reference, where it has one, and its events.
[[nodiscard]] Plot history_plot(const PlotSpec& spec, const RunData& run);

/// The plots of a run in groups: shape, surfactant, temperature and species, energy and stress,
/// mesh and solver. Plots without data and groups without plots are left out.
[[nodiscard]] std::vector<PlotGroup> history_plots(const RunData& run);

/// The plots of several runs overlaid: colours tell runs apart, dashes quantities.
[[nodiscard]] std::vector<PlotGroup> overlaid_plots(std::span<const RunData> runs,
                                                    std::span<const std::string> names);

}  // namespace meniscus::report
