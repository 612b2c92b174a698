#pragma once

#include <optional>
#include <vector>

#include "meniscus/io/table.hpp"
#include "meniscus/report/plot_catalogue.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// A quantity of a plot against time.
struct HistoryCurve {
  std::size_t quantity = 0;  ///< index into the plot's quantities
  int drop = -1;             ///< id of the drop; −1 for a table without drops
  std::vector<double> t, values;
};

/// The curves of a run for one plot, by drop and then by quantity. A column that is missing or has
/// no number gives no curve.
[[nodiscard]] std::vector<HistoryCurve> history_curves(const PlotSpec& plot, const RunData& run);
/// The curves of the run's reference for the columns of the plot.
[[nodiscard]] std::vector<HistoryCurve> reference_curves(const PlotSpec& plot, const RunData& run);

/// A column as numbers; empty when the table lacks it.
[[nodiscard]] std::vector<double> column_of(const std::optional<io::Table>& table,
                                            const std::string& name);

}  // namespace meniscus::report
