#include "meniscus/app/run_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <boost/math/interpolators/barycentric_rational.hpp>
#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/volume_corrections.hpp"

namespace meniscus {
namespace {

using Measure = CheckedQuantity::Measure;

/// Largest relative volume drift that a check accepts, for every drop.
constexpr double kLargestDrift = 1e-6;
/// Number of intervals at whose ends two runs are compared, where the check names no abscissae.
constexpr int kComparedPoints = 50;

/// The values of a column of drops.csv, by step, for one drop.
std::map<double, double> by_step(const io::Table& drops, const std::string& column, int drop) {
  const std::vector<double> steps = drops.column("step"), ids = drops.column("drop"),
                            values = drops.column(column);
  std::map<double, double> result;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (ids[i] == drop) result[steps[i]] = values[i];
  return result;
}

std::map<double, double> by_step(const RunTables& run, const std::string& column, int drop) {
  if (run.drops.find(column)) return by_step(run.drops, column, drop);
  if (!run.history.find(column))
    reject_input("{}: neither drops.csv nor history.csv has this column", column);
  const std::vector<double> steps = run.history.column("step"), values = run.history.column(column);
  std::map<double, double> result;
  for (std::size_t i = 0; i < steps.size(); ++i) result[steps[i]] = values[i];
  return result;
}

std::string name_of(const CheckedQuantity& quantity) {
  std::string name = quantity.is_magnitude ? fmt::format("|{}|", quantity.column) : quantity.column;
  if (quantity.event) return fmt::format("{} of event {}", name, *quantity.event);
  if (quantity.minus_drop) name += fmt::format(" of {} − {}", quantity.drop, *quantity.minus_drop);
  if (quantity.is_of_all_drops) name += " of all drops";
  if (quantity.measure == Measure::largest) return "largest " + name;
  if (quantity.measure == Measure::smallest) return "smallest " + name;
  if (quantity.measure == Measure::last) return "last " + name;
  return name + "(" + quantity.over + ")";
}

double deviation_of(const CheckedQuantity& quantity, double measured, double reference) {
  return quantity.is_absolute ? measured - reference : measured / reference - 1.0;
}

/// The largest, the smallest or the last value; none of none.
std::optional<double> extreme(const CheckedQuantity& quantity, const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  if (quantity.measure == Measure::largest) return *std::ranges::max_element(values);
  if (quantity.measure == Measure::smallest) return *std::ranges::min_element(values);
  return values.back();
}

/// The value of a column of events.csv in row `event`; none where there were fewer events.
std::optional<double> event_value(const RunTables& run, const std::string& column, int event) {
  if (event < 0 || event >= static_cast<int>(run.events.rows.size())) return std::nullopt;
  return run.events.column(column).at(static_cast<std::size_t>(event));
}

/// The number of a quantity in one run: the value of an event, an extreme, or the curve's value at
/// its only abscissa.
std::optional<double> signed_value(const CheckedQuantity& quantity, const RunTables& run) {
  if (quantity.event) return event_value(run, quantity.column, *quantity.event);
  if (quantity.is_of_all_drops) {
    std::vector<double> values = run.drops.column(quantity.column);
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return extreme(quantity, values);
  }
  const Series series = series_of(run, quantity);
  if (quantity.measure == Measure::curve) return value_at(series, quantity.at.at(0));
  return extreme(quantity, series.y);
}

/// The same, or its magnitude where that is asked for.
std::optional<double> single_value(const CheckedQuantity& quantity, const RunTables& run) {
  const std::optional<double> value = signed_value(quantity, run);
  return value && quantity.is_magnitude ? std::abs(*value) : value;
}

/// The limit a of the least-squares fit a + b N0^−order.
double limit(const std::vector<double>& nodes, const std::vector<double>& values, double order) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  MENISCUS_ASSERT(nodes.size() == values.size() && nodes.size() > 1, "{} values at {} N0",
                  values.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double x = std::pow(nodes[i], -order);
    n += 1.0;
    sx += x;
    sy += values[i];
    sxx += x * x;
    sxy += x * values[i];
  }
  return (sy * sxx - sx * sxy) / (n * sxx - sx * sx);
}

bool has_all_steps(const io::Table& history) {
  const std::vector<double> steps = history.column("step");
  return !steps.empty() && steps.back() + 1.0 == static_cast<double>(steps.size());
}

class Comparison {
 public:
  Comparison(std::string case_name, const CheckFile& check,
             const std::map<std::string, RunTables>& runs,
             const std::optional<io::Table>& reference)
      : case_name_(std::move(case_name)), check_(check), runs_(runs), reference_(reference) {}

  std::vector<CheckRow> rows() {
    for (const CheckedRun& run : check_.runs) {
      for (const CheckedQuantity& quantity : run.quantities) add_quantity(run.name, quantity);
      add_drift(run.name);
      add_corrections(run);
    }
    for (const CheckedExtrapolation& entry : check_.extrapolations) add_extrapolation(entry);
    return std::move(rows_);
  }

 private:
  CheckRow& add(const std::string& run, const CheckedQuantity& quantity) {
    rows_.push_back({.case_name = case_name_,
                     .run = run,
                     .quantity = name_of(quantity),
                     .worst = {},
                     .tolerance = quantity.tolerance,
                     .is_absolute = quantity.is_absolute,
                     .note = {}});
    return rows_.back();
  }

  void add_quantity(const std::string& run, const CheckedQuantity& quantity) {
    CheckRow& row = add(run, quantity);
    const auto found = runs_.find(run);
    if (found == runs_.end()) {
      row.note = "not run";
    } else if (quantity.measure != Measure::curve || quantity.reference) {
      compare_single(row, quantity, single_value(quantity, found->second));
    } else {
      compare_curve(row, quantity, series_of(found->second, quantity));
    }
  }

  void add_drift(const std::string& run) {
    const auto found = runs_.find(run);
    if (found == runs_.end()) return;
    const std::vector<double> drifts = found->second.drops.column("volume_drift");
    double drift = drifts.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    for (const double value : drifts)
      if (!(std::abs(value) <= drift)) drift = std::abs(value);  // what is no number stays one
    rows_.push_back({.case_name = case_name_,
                     .run = run,
                     .quantity = "largest volume_drift",
                     .worst = Deviation{0.0, 0.0, drift, drift},
                     .compared = 1,
                     .tolerance = kLargestDrift,
                     .is_absolute = true,
                     .note = {}});
  }

  /// Adds the row for the sum of the volume corrections. A record leaves out most steps and gives
  /// no row.
  void add_corrections(const CheckedRun& run) {
    const auto found = runs_.find(run.name);
    if (found == runs_.end() || !has_all_steps(found->second.history)) return;
    const auto sum = report::volume_correction_sum(found->second.drops);
    if (!sum) return;
    rows_.push_back({.case_name = case_name_,
                     .run = run.name,
                     .quantity = "sum of volume_correction",
                     .worst = Deviation{0.0, 0.0, *sum, *sum},
                     .compared = 1,
                     .tolerance = run.most_correction,
                     .is_absolute = true,
                     .note = {}});
  }

  void add_extrapolation(const CheckedExtrapolation& entry) {
    CheckRow& row = add(entry.name, entry.quantity);
    std::string missing;
    const std::optional<double> value = extrapolation(entry, missing);
    if (!value)
      row.note = missing;
    else
      compare_single(row, entry.quantity, value);
  }

  std::optional<double> extrapolation(const CheckedExtrapolation& entry,
                                      std::string& missing) const {
    std::vector<double> values;
    for (const std::string& name : entry.runs) {
      const auto found = runs_.find(name);
      const std::optional<double> value =
          found == runs_.end() ? std::nullopt : single_value(entry.quantity, found->second);
      if (!value) {
        missing = fmt::format("without \"{}\"", name);
        return std::nullopt;
      }
      values.push_back(*value);
    }
    return limit(entry.nodes, values, entry.order);
  }

  /// The reference of a quantity that is a single number.
  std::optional<double> single_reference(const CheckedQuantity& quantity) const {
    if (quantity.reference) return quantity.reference;
    if (quantity.against.empty()) return value_at(reference_series(quantity), quantity.at.at(0));
    if (const auto run = runs_.find(quantity.against); run != runs_.end())
      return single_value(quantity, run->second);
    const auto entry =
        std::ranges::find(check_.extrapolations, quantity.against, &CheckedExtrapolation::name);
    std::string missing;
    return entry == check_.extrapolations.end() ? std::nullopt : extrapolation(*entry, missing);
  }

  void compare_single(CheckRow& row, const CheckedQuantity& quantity,
                      std::optional<double> measured) const {
    const std::optional<double> reference = single_reference(quantity);
    if (!measured || !reference) {
      row.note = measured ? "no reference" : "not reached";
      return;
    }
    row.compared = 1;
    row.worst = {quantity.measure == Measure::curve ? quantity.at[0]
                                                    : std::numeric_limits<double>::quiet_NaN(),
                 *reference, *measured, deviation_of(quantity, *measured, *reference)};
  }

  [[nodiscard]] Series reference_series(const CheckedQuantity& quantity) const {
    if (!reference_) reject_input("{}: no reference.csv for {}", case_name_, quantity.column);
    return {reference_->column(quantity.over), reference_->column(quantity.column)};
  }

  void compare_curve(CheckRow& row, const CheckedQuantity& quantity, const Series& measured) const {
    Series reference;
    if (quantity.against.empty()) {
      reference = reference_series(quantity);
    } else {
      const auto run = runs_.find(quantity.against);
      if (run == runs_.end()) {
        row.note = fmt::format("without \"{}\"", quantity.against);
        return;
      }
      reference = series_of(run->second, quantity);
    }
    for (const double x : abscissae(quantity, measured, reference)) {
      const std::optional<double> a = value_at(measured, x), b = value_at(reference, x);
      if (!a || !b) continue;
      // A ratio to zero means nothing: spheres at rest have D = 0.
      if (!quantity.is_absolute && *b == 0.0) continue;
      ++row.compared;
      const Deviation deviation{x, *b, *a, deviation_of(quantity, *a, *b)};
      if (!row.worst || std::abs(deviation.deviation) > std::abs(row.worst->deviation))
        row.worst = deviation;
    }
    if (!row.worst) row.note = "not reached";
  }

  /// Where a curve is compared: at the abscissae of the check, else at the reference's rows. Two
  /// runs are compared at equal distances over their common range.
  static std::vector<double> abscissae(const CheckedQuantity& quantity, const Series& measured,
                                       const Series& reference) {
    if (!quantity.at.empty()) return quantity.at;
    if (quantity.against.empty()) return reference.x;
    std::vector<double> result;
    if (measured.x.empty() || reference.x.empty()) return result;
    const double begin = std::max(*std::ranges::min_element(measured.x),
                                  *std::ranges::min_element(reference.x)),
                 end = std::min(*std::ranges::max_element(measured.x),
                                *std::ranges::max_element(reference.x));
    for (int i = 0; i <= kComparedPoints && end > begin; ++i)
      result.push_back(begin + (end - begin) * i / kComparedPoints);
    return result;
  }

  std::string case_name_;
  const CheckFile& check_;
  const std::map<std::string, RunTables>& runs_;
  const std::optional<io::Table>& reference_;
  std::vector<CheckRow> rows_;
};

/// Value at x between rows i − 1 and i, where sign · abscissa rises. Cubic through two rows on
/// either side if the abscissa rises through all four, else linear.
double between_rows(const Series& series, std::size_t i, double sign, double x) {
  const auto begin = static_cast<std::ptrdiff_t>(i) - 2, end = begin + 4;
  MENISCUS_ASSERT(i > 0 && i < series.x.size(), "row {} of {}", i, series.x.size());
  if (begin >= 0 && end <= std::ssize(series.x)) {
    std::vector<double> xs(series.x.begin() + begin, series.x.begin() + end);
    for (double& value : xs) value *= sign;
    if (std::ranges::adjacent_find(xs, std::greater_equal()) == xs.end())
      return boost::math::barycentric_rational<double>(xs.data(), series.y.data() + begin, 4,
                                                       3)(sign * x);
  }
  const double part = (x - series.x[i - 1]) / (series.x[i] - series.x[i - 1]);
  return series.y[i - 1] + part * (series.y[i] - series.y[i - 1]);
}

}  // namespace

bool CheckRow::passes() const {
  return worst && tolerance && std::abs(worst->deviation) <= *tolerance;
}

Series series_of(const RunTables& run, const CheckedQuantity& quantity) {
  std::map<double, double> y = by_step(run, quantity.column, quantity.drop);
  if (quantity.minus_drop) {
    const std::map<double, double> other = by_step(run, quantity.column, *quantity.minus_drop);
    for (auto& [step, value] : y)
      value -= other.contains(step) ? other.at(step) : std::numeric_limits<double>::quiet_NaN();
  }
  const std::map<double, double> x = by_step(run, quantity.over, quantity.drop);
  Series series;
  for (const auto& [step, value] : y) {
    const auto found = x.find(step);
    if (found == x.end() || !std::isfinite(value) || !std::isfinite(found->second)) continue;
    series.x.push_back(found->second);
    series.y.push_back(value);
  }
  return series;
}

std::optional<double> value_at(const Series& series, double x) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (series.x[i] == x) return series.y[i];
    if (i == 0) continue;
    const double a = series.x[i - 1], b = series.x[i];
    if ((a < x && x < b) || (b < x && x < a)) return between_rows(series, i, a < b ? 1.0 : -1.0, x);
  }
  return std::nullopt;
}

std::vector<CheckRow> compare(const std::string& case_name, const CheckFile& check,
                              const std::map<std::string, RunTables>& runs,
                              const std::optional<io::Table>& reference) {
  return Comparison(case_name, check, runs, reference).rows();
}

}  // namespace meniscus
