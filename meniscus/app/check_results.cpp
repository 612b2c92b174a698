#include "meniscus/app/check_results.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meniscus/app/case_inputs.hpp"
#include "meniscus/app/run_json.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/version.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using io::RunFiles;

/// Number of steps that a record keeps, besides the last.
constexpr std::size_t kRecordedSteps = 120;

std::string provenance(const fs::path& folder) {
  const Json run = read_run_json(folder);
  const std::string none;
  return fmt::format("# {} {} ({}), {}: {} steps in {:.0f} s on one core\n",
                     member(run, "program", none), member(run, "version", none),
                     member(run, "commit", none), member(run, "finished", none).substr(0, 10),
                     member(run, "steps", 0), member(run, "wall_seconds", 0.0));
}

/// The step with the smallest gap: a regular stride would miss it. None without gaps.
std::optional<std::string> narrowest_step(const io::Table& history) {
  const std::vector<double> gaps = history.column("min_gap");
  std::optional<std::size_t> narrowest;
  for (std::size_t i = 0; i < gaps.size(); ++i)
    if (std::isfinite(gaps[i]) && (!narrowest || gaps[i] < gaps[*narrowest])) narrowest = i;
  if (!narrowest) return std::nullopt;
  return history.rows[*narrowest][history.index_of("step")];
}

/// Every k-th step, the last step and the one with the smallest gap.
std::set<std::string> kept_steps(const io::Table& history) {
  const std::size_t column = history.index_of("step"), count = history.rows.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (count + kRecordedSteps - 1) / kRecordedSteps);
  std::set<std::string> steps;
  for (std::size_t i = 0; i < count; ++i)
    if (i % stride == 0 || i + 1 == count) steps.insert(history.rows[i][column]);
  if (const auto step = narrowest_step(history)) steps.insert(*step);
  return steps;
}

/// A number with seven significant digits, more than any comparison uses. Other cells unchanged.
std::string short_number(const std::string& cell) {
  if (cell.find_first_of(".e") == std::string::npos) return cell;
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return end == cell.c_str() + cell.size() ? fmt::format("{:.7g}", value) : cell;
}

std::string table_text(const io::Table& table, const std::set<std::string>& steps) {
  const std::size_t column = table.index_of("step");
  std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const std::vector<std::string>& row : table.rows) {
    if (!steps.contains(row[column])) continue;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0) text += ',';
      text += short_number(row[k]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string file_name_of(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 128 && std::isalnum(u) != 0)
      result += static_cast<char>(std::tolower(u));
    else if (!result.empty() && result.back() != '-')
      result += '-';
  }
  while (!result.empty() && result.back() == '-') result.pop_back();
  return result;
}

RunState state_of_run(const fs::path& folder, const Case& c) {
  const Json run = read_run_json(folder);
  if (member(run, "commit", std::string()) != commit_string || !run.contains("case") ||
      run["case"] != Json::parse(case_json(c)) ||
      member(run, "inputs", std::map<std::string, std::string>()) != case_inputs(c))
    return RunState::absent;
  return member(run, "status", std::string()) == "done" ? RunState::finished : RunState::unfinished;
}

RunTables read_run_tables(const fs::path& folder) {
  return {io::read_table(folder / RunFiles::drops), io::read_table(folder / RunFiles::history),
          io::read_table(folder / RunFiles::events)};
}

fs::path recorded_file(const fs::path& results, const std::string& run, const char* file) {
  return results / fmt::format("{}-{}", file_name_of(run), file);
}

RunTables read_record(const fs::path& results, const std::string& run) {
  const auto read = [&](const char* file) {
    return io::read_commented_table(recorded_file(results, run, file));
  };
  const bool has_events = fs::exists(recorded_file(results, run, RunFiles::events));
  return {read(RunFiles::drops), read(RunFiles::history),
          has_events ? read(RunFiles::events) : io::Table{}};
}

void write_record(const fs::path& results, const std::string& run, const fs::path& folder) {
  const RunTables tables = read_run_tables(folder);
  const std::set<std::string> steps = kept_steps(tables.history);
  const std::string head = provenance(folder);
  fs::create_directories(results);
  const auto write = [&](const char* file, const io::Table& table, const auto& kept) {
    io::write_file(recorded_file(results, run, file), head + table_text(table, kept));
  };
  write(RunFiles::drops, tables.drops, steps);
  write(RunFiles::history, tables.history, steps);
  if (tables.events.rows.empty()) return;
  std::set<std::string> all;
  const std::size_t step = tables.events.index_of("step");
  for (const auto& row : tables.events.rows) all.insert(row[step]);
  write(RunFiles::events, tables.events, all);
}

}  // namespace meniscus
