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
  int drop = -1;             ///< whose it is; −1 of a table without drops
  std::vector<double> t, values;
};

/// What the tables of a run give for a plot, drop by drop and in each the quantities in their
/// order; a column that is missing or without a number gives nothing.
[[nodiscard]] std::vector<HistoryCurve> history_curves(const PlotSpec& plot, const RunData& run);
/// What its reference gives for the columns of the same names.
[[nodiscard]] std::vector<HistoryCurve> reference_curves(const PlotSpec& plot, const RunData& run);

/// A column as numbers; empty when it is not there.
[[nodiscard]] std::vector<double> column_of(const std::optional<io::Table>& table,
                                            const std::string& name);

}  // namespace meniscus::report
