#include "meniscus/report/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/report/history_curves.hpp"

namespace meniscus::report {
namespace {

constexpr std::array compared_columns = {"D",         "L",     "B",    "W",
                                         "angle_deg", "H_max", "area", "volume"};

/// The specification of a plot with one column of drops.csv.
PlotSpec measure(const char* column) {
  return {.group = {}, .title = {}, .unit = {}, .table = "drops", .quantities = {{column, column}}};
}

std::optional<HistoryCurve> curve_of_drop(const std::vector<HistoryCurve>& curves, int drop) {
  const auto found = std::ranges::find(curves, drop, &HistoryCurve::drop);
  return found == curves.end() ? std::nullopt : std::optional(*found);
}

Difference difference(const HistoryCurve& first, const HistoryCurve& run, double end) {
  Difference result;
  result.drop = run.drop;
  result.at_end = value_at(run.t, run.values, end);
  result.first_at_end = value_at(first.t, first.values, end);
  // Both curves are piecewise linear, so the largest difference is at a row of one of them.
  for (const std::vector<double>* times : {&first.t, &run.t}) {
    for (const double t : *times) {
      const double here =
          std::abs(value_at(run.t, run.values, t) - value_at(first.t, first.values, t));
      if (!(t <= end) || !std::isfinite(here) || result.largest >= here) continue;
      result.largest = here;
      result.t_of_largest = t;
    }
  }
  return result;
}

}  // namespace

double common_end(std::span<const RunData> runs) {
  double end = std::numeric_limits<double>::infinity();
  for (const RunData& run : runs) {
    const std::vector<double> t = column_of(run.drops, "t");
    end = t.empty() ? std::numeric_limits<double>::quiet_NaN() : std::min(end, t.back());
    if (std::isnan(end)) break;
  }
  return end;
}

std::vector<Difference> differences(const RunData& first, const RunData& run, double end) {
  std::vector<Difference> list;
  for (const char* column : compared_columns) {
    const std::vector<HistoryCurve> of_first = history_curves(measure(column), first);
    for (const HistoryCurve& curve : history_curves(measure(column), run)) {
      const auto other = curve_of_drop(of_first, curve.drop);
      if (!other) continue;
      list.push_back(difference(*other, curve, end));
      list.back().quantity = column;
    }
  }
  return list;
}

double value_at(std::span<const double> x, std::span<const double> y, double t) {
  MENISCUS_ASSERT(x.size() == y.size(), "{} times of {} values", x.size(), y.size());
  const auto after = std::ranges::lower_bound(x, t);
  if (after == x.end()) return std::numeric_limits<double>::quiet_NaN();
  const auto i = static_cast<std::size_t>(after - x.begin());
  if (*after == t) return y[i];
  if (i == 0) return std::numeric_limits<double>::quiet_NaN();
  const double weight = (t - x[i - 1]) / (x[i] - x[i - 1]);
  return (1.0 - weight) * y[i - 1] + weight * y[i];
}

}  // namespace meniscus::report
