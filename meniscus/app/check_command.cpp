#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "meniscus/app/benchmark_comparison.hpp"
#include "meniscus/app/check_results.hpp"
#include "meniscus/app/commands.hpp"
#include "meniscus/app/output_file.hpp"
#include "meniscus/app/run_comparison.hpp"
#include "meniscus/app/shipped_docs.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/case/check_file.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/version.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/check_page.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using report::CheckLine;

/// The folders below `cases` that hold a check.toml, by name.
std::vector<fs::path> all_cases(const fs::path& cases) {
  std::vector<fs::path> folders;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(cases, unreadable))
    if (fs::exists(entry.path() / "check.toml")) folders.push_back(entry.path());
  if (folders.empty())
    reject_input("{}: no folder here holds a check.toml; name one, or give --cases",
                 cases.string());
  std::ranges::sort(folders);
  return folders;
}

bool is_benchmark(const std::string& name) {
  return std::ranges::find(benchmark_files(), name, &BenchmarkFile::name) !=
         benchmark_files().end();
}

/// The folder of a case. A bare name is looked for in `cases` first, and then here, at last what
/// was installed.
fs::path case_folder(const std::string& name, const fs::path& cases) {
  fs::path folder = fs::path(name).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const bool is_bare_name = !folder.has_parent_path();
  if (is_bare_name && fs::exists(cases / folder / "check.toml")) return cases / folder;
  for (const fs::path& place : {folder, shipped_docs() / folder})
    if (fs::exists(place / "check.toml")) return place;
  reject_input("{}: no validation case: {} check.toml{}", name,
               is_bare_name ? fmt::format("neither it nor {} holds a", (cases / folder).string())
                            : "it holds no",
               is_benchmark(name) ? "; to use the benchmark, give --against FILE.csv" : "");
}

/// The folder of the cases: the one given, else cases/ here, else the one shipped with the program.
fs::path cases_of(const CheckArguments& arguments) {
  if (!arguments.cases.empty()) return arguments.cases;
  const fs::path here = "cases", shipped = shipped_docs() / here;
  return !fs::exists(here) && fs::exists(shipped) ? shipped : here;
}

std::vector<fs::path> chosen_cases(const CheckArguments& arguments) {
  const fs::path cases = cases_of(arguments);
  if (arguments.is_all) return all_cases(cases);
  std::vector<fs::path> folders;
  for (const std::string& name : arguments.directories) folders.push_back(case_folder(name, cases));
  if (folders.empty()) reject_input("check: name the folder of a case, or give --all");
  return folders;
}

/// Whether the options select a run. A run marked once is repeated only on request.
bool is_chosen(const CheckedRun& run, const CheckArguments& arguments) {
  if (!arguments.runs.empty())
    return std::ranges::find(arguments.runs, run.name) != arguments.runs.end();
  if (arguments.is_short) return run.is_short;
  return !run.is_once || arguments.is_once || arguments.is_recorded;
}

/// Makes the run of a check, or resumes it where it stopped. Returns whether it reached its end.
bool simulate(const fs::path& case_file, const CheckedRun& run, const fs::path& folder,
              bool is_quiet) {
  RunState state = state_of_run(folder, read_case(case_file, run.overrides));
  if (state == RunState::unfinished && io::checkpoints(folder).empty()) state = RunState::absent;
  switch (state) {
    case RunState::finished:
      return true;
    case RunState::unfinished:
      return resume_command({.directory = folder.string(),
                             .until = {},
                             .from = {},
                             .output = {},
                             .is_quiet = is_quiet}) == 0;
    case RunState::absent:
      break;
  }
  fs::create_directories(folder.parent_path());
  RunArguments arguments;
  arguments.case_file = case_file.string();
  arguments.output = folder.string();
  arguments.overrides = run.overrides;
  arguments.is_overwrite = true;
  arguments.is_quiet = is_quiet;
  return run_command(arguments) == 0;
}

/// The tables of every selected run, simulated or read from the record.
std::map<std::string, RunTables> tables_of(const fs::path& folder, const std::string& name,
                                           const CheckFile& check,
                                           const CheckArguments& arguments) {
  std::map<std::string, RunTables> tables;
  for (const CheckedRun& run : check.runs) {
    if (!is_chosen(run, arguments)) continue;
    if (arguments.is_recorded) {
      if (fs::exists(recorded_file(folder / "results", run.name, io::RunFiles::drops)))
        tables[run.name] = read_record(folder / "results", run.name);
      continue;
    }
    const fs::path output =
        fs::path(arguments.output) / fmt::format("{}-{}", name, file_name_of(run.name));
    if (!arguments.is_quiet) fmt::print(stderr, "{}: {}\n", name, run.name);
    if (!simulate(folder / "case.toml", run, output, arguments.is_quiet))
      throw RunFailure(
          fmt::format("{}: {}: the run stopped; check again to go on with it", name, run.name));
    tables[run.name] = read_run_tables(output);
    if (arguments.is_record) write_record(folder / "results", run.name, output);
  }
  return tables;
}

std::string amount(double value, bool is_absolute, bool is_signed) {
  if (is_absolute) return is_signed ? fmt::format("{:+.2g}", value) : fmt::format("{:.2g}", value);
  return is_signed ? fmt::format("{:+.2f} %", 100.0 * value)
                   : fmt::format("{:.2g} %", 100.0 * value);
}

CheckLine line_of(const CheckRow& row) {
  CheckLine line{.case_name = row.case_name,
                 .run = row.run,
                 .quantity = row.quantity,
                 .at = {},
                 .reference = {},
                 .measured = {},
                 .deviation = row.note,
                 .tolerance = {}};
  if (row.tolerance) line.tolerance = amount(*row.tolerance, row.is_absolute, false);
  line.verdict = !row.worst       ? CheckLine::Verdict::missing
                 : !row.is_held() ? CheckLine::Verdict::reported
                 : row.passes()   ? CheckLine::Verdict::passed
                                  : CheckLine::Verdict::failed;
  if (!row.worst) return line;
  if (row.compared > 1)
    line.at = fmt::format("{:.4g} (worst of {})", row.worst->at, row.compared);
  else if (std::isfinite(row.worst->at) && row.worst->at != 0.0)
    line.at = fmt::format("{:.4g}", row.worst->at);
  line.reference = fmt::format("{:.5g}", row.worst->reference);
  line.measured = fmt::format("{:.5g}", row.worst->measured);
  line.deviation = amount(row.worst->deviation, row.is_absolute, true);
  return line;
}

std::vector<CheckRow> check_case(const fs::path& folder, const CheckArguments& arguments) {
  const std::string name = fs::absolute(folder).filename().string();
  const CheckFile check = read_check_file(folder / "check.toml");
  std::optional<io::Table> reference;
  if (fs::exists(folder / "reference.csv"))
    reference = io::read_commented_table(folder / "reference.csv");
  std::vector<CheckRow> rows =
      compare(name, check, tables_of(folder, name, check, arguments), reference);
  // Runs that were not selected give no rows. With --recorded a missing record stays in the table.
  if (!arguments.is_recorded || !arguments.runs.empty())
    std::erase_if(rows, [](const CheckRow& row) {
      return row.note == "not run" || row.note.starts_with("without");
    });
  return rows;
}

int list_benchmarks() {
  for (const BenchmarkFile& file : benchmark_files()) {
    const Benchmark each = read_benchmark(std::string(file.name), file.text);
    fmt::print("{:<30} {}\n", each.name, each.title);
  }
  return 0;
}

int check_against_benchmark(const CheckArguments& arguments) {
  if (arguments.directories.size() != 1)
    reject_input("check --against: name one benchmark; meniscus check --benchmarks lists them");
  const Benchmark reference = benchmark(arguments.directories[0]);
  if (!arguments.output.empty()) require_writable(arguments.output);
  const BenchmarkComparison comparison = compare_with_benchmark(
      reference, io::read_commented_table(arguments.against), arguments.against, arguments.columns);
  if (!arguments.output.empty()) io::write_file(arguments.output, comparison_csv(comparison));
  fmt::print("{}", comparison_text(reference, comparison, arguments.against));
  return std::ranges::all_of(comparison.columns, &ColumnDifference::is_within) ? 0 : 1;
}

int check_cases(const CheckArguments& arguments) {
  if (arguments.is_recorded && arguments.is_record)
    reject_input("--record writes what --recorded reads: only one of them");
  std::vector<CheckLine> lines;
  int failed = 0, held = 0;
  for (const fs::path& folder : chosen_cases(arguments))
    for (const CheckRow& row : check_case(folder, arguments)) {
      lines.push_back(line_of(row));
      // A missing record does not count as a failure. A run that was just made always counts.
      const bool is_counted = row.is_held() && (row.worst || !arguments.is_recorded);
      held += is_counted ? 1 : 0;
      failed += is_counted && !row.passes() ? 1 : 0;
    }
  if (lines.empty())
    reject_input("check: no run is chosen{}",
                 arguments.is_short ? ": none of these cases has a short one" : "");
  fmt::print("{}\n{} of {} passed\n", report::check_text(lines), held - failed, held);
  fs::create_directories(arguments.output);
  report::write_check_page(
      lines,
      fmt::format("Meniscus {} ({}): {} of {} quantities within their tolerance{}.", version_string,
                  commit_string, held - failed, held,
                  arguments.is_recorded ? ", as recorded beside the cases" : ""),
      fs::path(arguments.output) / "check.html");
  return failed > 0 ? 1 : 0;
}

}  // namespace

int check_command(CheckArguments arguments) {
  if (arguments.is_list) return list_benchmarks();
  if (!arguments.against.empty()) return check_against_benchmark(arguments);
  if (arguments.output.empty()) arguments.output = "out/check";
  return check_cases(arguments);
}

}  // namespace meniscus
