#include "meniscus/report/history_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "meniscus/core/error.hpp"

namespace meniscus::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool has_numbers(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
}

/// One curve per column of a table without drops.
std::vector<HistoryCurve> plain_curves(const PlotSpec& plot,
                                       const std::optional<io::Table>& table) {
  std::vector<HistoryCurve> curves;
  for (std::size_t q = 0; q < plot.quantities.size(); ++q) {
    std::vector<double> values = column_of(table, plot.quantities[q].column);
    if (has_numbers(values)) curves.push_back({q, -1, column_of(table, "t"), std::move(values)});
  }
  std::erase_if(curves, [](const HistoryCurve& c) { return c.t.size() != c.values.size(); });
  return curves;
}

/// The curves of drops.csv, one per drop and column.
std::vector<HistoryCurve> drop_curves(const PlotSpec& plot, const RunData& run) {
  const std::vector<double> ids = column_of(run.drops, "drop");
  std::map<int, std::vector<std::size_t>> drop_to_rows;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (std::isfinite(ids[i])) drop_to_rows[static_cast<int>(ids[i])].push_back(i);
  }
  const std::vector<HistoryCurve> together = plain_curves(plot, run.drops);
  std::vector<HistoryCurve> curves;
  for (const auto& [drop, rows] : drop_to_rows) {
    for (const HistoryCurve& all : together) {
      MENISCUS_ASSERT(rows.back() < all.t.size(), "row {} of {}", rows.back(), all.t.size());
      HistoryCurve& curve = curves.emplace_back(HistoryCurve{all.quantity, drop, {}, {}});
      for (const std::size_t row : rows) {
        curve.t.push_back(all.t[row]);
        curve.values.push_back(all.values[row]);
      }
    }
  }
  return curves;
}

std::vector<HistoryCurve> percent_curve(const PlotSpec& plot, const RunData& run) {
  std::vector<HistoryCurve> curves = plain_curves(plot, run.history);
  if (curves.size() != 2) return {};
  for (std::size_t i = 0; i < curves[0].values.size(); ++i) {
    curves[0].values[i] *= 100.0 / std::abs(curves[1].values[i]);
  }
  curves.pop_back();
  return curves;
}

std::vector<HistoryCurve> sum_curve(const RunData& run) {
  if (!run.timing) return {};
  HistoryCurve sum{0, -1, column_of(run.timing, "t"), {}};
  if (sum.t.empty()) return {};
  sum.values.assign(sum.t.size(), 0.0);
  for (const std::string& column : run.timing->columns) {
    if (column == "step" || column == "t") continue;
    const std::vector<double> values = run.timing->column(column);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) sum.values[i] += values[i];
    }
  }
  return {sum};
}

}  // namespace

std::vector<double> column_of(const std::optional<io::Table>& table, const std::string& name) {
  return table && table->find(name) ? table->column(name) : std::vector<double>();
}

std::vector<HistoryCurve> history_curves(const PlotSpec& plot, const RunData& run) {
  if (plot.derivation == Derivation::percent) return percent_curve(plot, run);
  if (plot.derivation == Derivation::sum) return sum_curve(run);
  std::vector<HistoryCurve> curves =
      plot.table == "drops" ? drop_curves(plot, run) : plain_curves(plot, run.history);
  if (plot.derivation == Derivation::gap_at_zeros) {
    for (HistoryCurve& curve : curves) std::ranges::replace(curve.values, 0.0, nan);
  }
  return curves;
}

std::vector<HistoryCurve> reference_curves(const PlotSpec& plot, const RunData& run) {
  return plot.derivation == Derivation::none ? plain_curves(plot, run.reference)
                                             : std::vector<HistoryCurve>();
}

}  // namespace meniscus::report
