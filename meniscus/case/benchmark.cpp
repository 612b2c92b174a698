#include "meniscus/case/benchmark.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

#include "meniscus/case/nearest_word.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/table_text.hpp"

namespace meniscus {
namespace {

// cmake/Examples.cmake writes these entries: {"name", R"text(…)text"}, …
constexpr BenchmarkFile kBenchmarks[] = {
#include "meniscus/case/benchmarks_generated.inc"
};

/// The comment lines at the head of a table, without "# ", continued lines joined.
std::vector<std::string> header_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (text.starts_with("# ")) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(2, end - 2);
    const bool goes_on = line.starts_with("  ") && !lines.empty();
    if (goes_on)
      lines.back().append(" ").append(line.substr(2));
    else
      lines.emplace_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Columns by name; that of `t` has neither error nor tolerance.
std::map<std::string, BenchmarkColumn> described_columns(const std::vector<std::string>& lines) {
  static const std::regex form(
      R"(column (\S+) \[([^\]]+)\](?:, error ([-+.e\d]+), tolerance ([-+.e\d]+))?: (.+))");
  std::map<std::string, BenchmarkColumn> columns;
  std::smatch part;
  for (const std::string& line : lines)
    if (std::regex_match(line, part, form))
      columns[part[1]] = {.name = part[1],
                          .unit = part[2],
                          .meaning = part[5],
                          .error = part[3].matched ? std::stod(part[3]) : 0.0,
                          .tolerance = part[4].matched ? std::stod(part[4]) : 0.0};
  return columns;
}

std::string value_of(const std::string& name, const std::vector<std::string>& lines,
                     const std::string& key) {
  for (const std::string& line : lines)
    if (line.starts_with(key + ": ")) return line.substr(key.size() + 2);
  reject_input("benchmark {}: the header has no line \"# {}: …\"", name, key);
}

void require_numbers(const Benchmark& benchmark) {
  if (benchmark.table.columns.at(0) != "t" || benchmark.table.rows.size() < 2)
    reject_input("benchmark {}: the first column is not t, or has less than two rows",
                 benchmark.name);
  for (const std::string& column : benchmark.table.columns)
    for (const double value : benchmark.table.column(column))
      if (!std::isfinite(value))
        reject_input("benchmark {}: {} has a cell that is no finite number", benchmark.name,
                     column);
  const std::vector<double> t = benchmark.table.column("t");
  if (std::ranges::adjacent_find(t, std::greater_equal()) != t.end())
    reject_input("benchmark {}: t does not rise", benchmark.name);
}

}  // namespace

std::span<const BenchmarkFile> benchmark_files() { return kBenchmarks; }

Benchmark read_benchmark(const std::string& name, std::string_view text) {
  const std::vector<std::string> lines = header_lines(text);
  for (const char* key : {"set-up", "equations", "provenance"}) (void)value_of(name, lines, key);
  Benchmark result{.name = name,
                   .title = value_of(name, lines, "title"),
                   .licence = value_of(name, lines, "licence"),
                   .columns = {},
                   .table = io::parse_commented_table("benchmark " + name, text)};
  require_numbers(result);
  const std::map<std::string, BenchmarkColumn> described = described_columns(lines);
  for (const std::string& column : result.table.columns) {
    const auto found = described.find(column);
    if (found == described.end() || (column != "t" && !(found->second.tolerance > 0.0)))
      reject_input(
          "benchmark {}: {}: no line \"# column {} [UNIT], error E, tolerance T: meaning\"", name,
          column, column);
    if (column != "t") result.columns.push_back(found->second);
  }
  return result;
}

Benchmark benchmark(const std::string& name) {
  const auto found = std::ranges::find(benchmark_files(), name, &BenchmarkFile::name);
  if (found != benchmark_files().end()) return read_benchmark(name, found->text);
  std::vector<std::string_view> names;
  for (const BenchmarkFile& file : benchmark_files()) names.push_back(file.name);
  const std::string_view near = nearest_word(name, names);
  reject_input("check --against: \"{}\" is not one of the benchmarks {}{}", name,
               fmt::join(names, ", "),
               near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

}  // namespace meniscus
