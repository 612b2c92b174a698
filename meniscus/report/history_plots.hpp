#pragma once

#include <vector>

#include "meniscus/report/run_data.hpp"
#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// A heading and the plots under it.
struct PlotGroup {
  std::string heading;
  std::vector<Plot> plots;
};

/// The plots that the tables of a run allow: shape, energy and stress, mesh and solver. A plot
/// whose columns are missing or empty is left out, and so is a group without plots.
[[nodiscard]] std::vector<PlotGroup> history_plots(const RunData& run);

}  // namespace meniscus::report
