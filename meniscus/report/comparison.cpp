#include "meniscus/report/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "meniscus/core/error.hpp"

namespace meniscus::report {
namespace {

constexpr std::array compared_columns = {"D",         "L",     "B",    "W",
                                         "angle_deg", "H_max", "area", "volume"};

/// A column of drops.csv for one drop.
struct DropCurve {
  std::vector<double> t = {}, values = {};
};

std::vector<double> column_of(const std::optional<io::Table>& table, const char* name) {
  return table && table->find(name) ? table->column(name) : std::vector<double>();
}

/// The values of a column by drop; empty where the table lacks it or has no number in it.
std::map<int, DropCurve> drop_curves(const RunData& run, const char* column) {
  const std::vector<double> t = column_of(run.drops, "t"), ids = column_of(run.drops, "drop"),
                            values = column_of(run.drops, column);
  std::map<int, DropCurve> curves;
  if (t.size() != values.size() || ids.size() != values.size()) return curves;
  if (std::ranges::none_of(values, [](double v) { return std::isfinite(v); })) return curves;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!std::isfinite(ids[i])) continue;
    DropCurve& curve = curves[static_cast<int>(ids[i])];
    curve.t.push_back(t[i]);
    curve.values.push_back(values[i]);
  }
  return curves;
}

Difference difference(const DropCurve& first, const DropCurve& run, double end) {
  Difference result;
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
    const std::map<int, DropCurve> of_first = drop_curves(first, column);
    for (const auto& [drop, curve] : drop_curves(run, column)) {
      const auto other = of_first.find(drop);
      if (other == of_first.end()) continue;
      list.push_back(difference(other->second, curve, end));
      list.back().quantity = column;
      list.back().drop = drop;
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
