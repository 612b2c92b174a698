#include "meniscus/app/benchmark_comparison.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "meniscus/app/run_comparison.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// A cell as a number; none where it is empty. Throws InvalidInput at anything else.
std::optional<double> number_of(const io::Table& table, std::size_t row, std::size_t column,
                                const std::string& file) {
  const std::string& cell = table.rows[row][column];
  if (cell.find_first_not_of(' ') == std::string::npos) return std::nullopt;
  const char* begin = cell.data() + cell.find_first_not_of(" +");
  const char* last = cell.data() + cell.find_last_not_of(' ') + 1;
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    reject_input("{}: row {} below the header: {} = `{}` is not a finite number", file, row + 1,
                 table.columns[column], cell);
  return value;
}

std::vector<double> times(const io::Table& table, const std::string& file) {
  const std::optional<std::size_t> column = table.find("t");
  if (!column)
    reject_input("{}: has no column `t`; it has {}", file, fmt::join(table.columns, ", "));
  std::vector<double> t;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::optional<double> value = number_of(table, row, *column, file);
    if (!value) reject_input("{}: row {} below the header: t is empty", file, row + 1);
    if (!t.empty() && *value <= t.back())
      reject_input(
          "{}: row {} below the header: t = {} does not rise from {}; one row a time is "
          "wanted, in order",
          file, row + 1, *value, t.back());
    t.push_back(*value);
  }
  return t;
}

Series series_of_column(const io::Table& table, const std::vector<double>& t,
                        const std::string& column, const std::string& file) {
  Series series;
  const std::size_t index = table.index_of(column);
  for (std::size_t row = 0; row < t.size(); ++row)
    if (const std::optional<double> value = number_of(table, row, index, file)) {
      series.x.push_back(t[row]);
      series.y.push_back(*value);
    }
  if (series.x.empty()) reject_input("{}: column {} has no numbers", file, column);
  return series;
}

std::vector<double> within(const std::vector<double>& x, double begin, double end) {
  std::vector<double> result;
  std::ranges::copy_if(x, std::back_inserter(result),
                       [&](double value) { return begin <= value && value <= end; });
  return result;
}

/// The rows of the series with fewer rows between two times, unless it has none.
std::vector<double> compared_times(const Series& a, const Series& b, double begin, double end) {
  std::vector<double> of_a = within(a.x, begin, end), of_b = within(b.x, begin, end);
  return of_b.empty() || (!of_a.empty() && of_a.size() <= of_b.size()) ? of_a : of_b;
}

ColumnDifference difference(const BenchmarkColumn& column, const Series& reference,
                            const Series& measured, const std::string& file) {
  ColumnDifference result{.column = column,
                          .begin = std::max(reference.x.front(), measured.x.front()),
                          .end = std::min(reference.x.back(), measured.x.back())};
  double squares = 0.0;
  for (const double t : compared_times(reference, measured, result.begin, result.end)) {
    const std::optional<double> a = value_at(measured, t), b = value_at(reference, t);
    if (!a || !b) continue;
    const double here = std::abs(*a - *b);
    if (result.compared++ == 0 || here > result.largest) {
      result.largest = here;
      result.at = t;
    }
    squares += here * here;
  }
  if (result.compared == 0)
    reject_input(
        "{}: {}: t = {:.6g} to {:.6g} does not overlap with the benchmark's {:.6g} to {:.6g}", file,
        column.name, measured.x.front(), measured.x.back(), reference.x.front(),
        reference.x.back());
  result.rms = std::sqrt(squares / result.compared);
  return result;
}

std::vector<std::string> names_of(const Benchmark& benchmark) {
  std::vector<std::string> names;
  for (const BenchmarkColumn& column : benchmark.columns) names.push_back(column.name);
  return names;
}

void require_columns(const Benchmark& benchmark, const io::Table& table, const std::string& file,
                     const std::vector<std::string>& chosen) {
  const std::vector<std::string> names = names_of(benchmark);
  for (const std::string& name : chosen) {
    if (std::ranges::find(names, name) == names.end())
      reject_input("--columns: {} is not one of benchmark {}'s: {}", name, benchmark.name,
                   fmt::join(names, ", "));
    if (!table.find(name))
      reject_input("{}: has no column {}; it has {}", file, name, fmt::join(table.columns, ", "));
  }
  if (std::ranges::none_of(names, [&](const auto& name) { return table.find(name).has_value(); }))
    reject_input("{}: has none of the columns {} of benchmark {}; it has {}", file,
                 fmt::join(names, ", "), benchmark.name, fmt::join(table.columns, ", "));
}

}  // namespace

BenchmarkComparison compare_with_benchmark(const Benchmark& benchmark, const io::Table& table,
                                           const std::string& file,
                                           const std::vector<std::string>& chosen) {
  const std::vector<double> t = times(table, file);
  require_columns(benchmark, table, file, chosen);
  BenchmarkComparison result;
  const std::vector<double> reference_t = benchmark.table.column("t");
  for (const BenchmarkColumn& column : benchmark.columns) {
    if (!chosen.empty() && std::ranges::find(chosen, column.name) == chosen.end()) continue;
    if (!table.find(column.name)) {
      result.missing.push_back(column.name);
      continue;
    }
    const Series reference{reference_t, benchmark.table.column(column.name)};
    result.columns.push_back(
        difference(column, reference, series_of_column(table, t, column.name, file), file));
  }
  return result;
}

std::string comparison_text(const Benchmark& benchmark, const BenchmarkComparison& comparison,
                            const std::string& file) {
  const char* row = "{:<16} {:<8} {:>17} {:>6} {:>10} {:>8} {:>10} {:>10} {:>10}  {}\n";
  std::string text = fmt::format("{}: {}\n{}\n", benchmark.name, benchmark.title, file);
  text += fmt::format(fmt::runtime(row), "column", "unit", "t", "times", "largest", "at", "rms",
                      "ref. error", "tolerance", "");
  for (const ColumnDifference& each : comparison.columns)
    text += fmt::format(fmt::runtime(row), each.column.name, each.column.unit,
                        fmt::format("{:.4g} to {:.4g}", each.begin, each.end), each.compared,
                        fmt::format("{:.2g}", each.largest), fmt::format("{:.4g}", each.at),
                        fmt::format("{:.2g}", each.rms), fmt::format("{:.2g}", each.column.error),
                        fmt::format("{:.2g}", each.column.tolerance),
                        each.is_within() ? "within" : "BEYOND");
  const auto held = std::ranges::count_if(comparison.columns, &ColumnDifference::is_within);
  text += fmt::format("{} of {} columns within their tolerance\n", held, comparison.columns.size());
  if (!comparison.missing.empty())
    text += fmt::format("not in {}: {}\n", file, fmt::join(comparison.missing, ", "));
  return text;
}

std::string comparison_csv(const BenchmarkComparison& comparison) {
  std::string text = "column,unit,t_begin,t_end,compared,largest,at,rms,error,tolerance,within\n";
  for (const ColumnDifference& each : comparison.columns)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", each.column.name, each.column.unit,
                        each.begin, each.end, each.compared, each.largest, each.at, each.rms,
                        each.column.error, each.column.tolerance, each.is_within() ? "yes" : "no");
  return text;
}

}  // namespace meniscus
