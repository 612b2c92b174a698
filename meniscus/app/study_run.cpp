#include "meniscus/app/study_run.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstring>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meniscus/app/check_results.hpp"
#include "meniscus/app/run_directory.hpp"
#include "meniscus/app/run_json.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/evolve/stop_rules.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 120;  // file systems take 255, and a value may follow

/// "viscosity-ratio=0.1": safe in names of files and in links.
std::string name_of(const std::string& key, const std::string& value) {
  std::string name = fmt::format("{}={}", schema::leaf(key), value);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::strchr("=.+-", c) == nullptr)
      c = '_';
  return name;
}

/// A name for every point, of its values; by number where those give no short or unique ones.
std::vector<std::string> names_of(const StudyFile& study, const std::vector<StudyPoint>& points) {
  std::vector<std::string> names;
  bool is_short = true;
  for (const StudyPoint& point : points) {
    std::string name;
    for (std::size_t i = 0; i < point.size(); ++i)
      name += fmt::format("{}{}", i > 0 ? "_" : "", name_of(study.axes[i].key, point[i]));
    is_short = is_short && name.size() <= kLongestName;
    names.push_back(std::move(name));
  }
  const bool are_unique = std::set<std::string>(names.begin(), names.end()).size() == names.size();
  if (is_short && are_unique) return names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = fmt::format("point-{:05}", i + 1);
  return names;
}

/// The end time of a run that was prolonged so many times, in the case's own units.
double prolonged_end(const Case& c, int prolongations) {
  return std::get<double>(c.settings.used().at("time.end")) * std::ldexp(1.0, prolongations);
}

/// Why a run ended, by its run.json: "time", "steady", …; empty where it does not say.
std::string ending_of_run(const fs::path& folder) {
  return member(read_run_json(folder), "ended", std::string());
}

std::string last_line(const fs::path& file) {
  std::string text = fs::exists(file) ? io::read_file(file) : std::string();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t line = text.rfind('\n');
  if (line != std::string::npos) text.erase(0, line + 1);
  constexpr std::string_view kProgram = "meniscus: ";
  return text.starts_with(kProgram) ? text.substr(kProgram.size()) : text;
}

}  // namespace

Verdict StudyRunResult::verdict() const {
  if (!failure.empty()) return Verdict::failed;
  if (ended == "steady") return Verdict::steady;
  return ended == "broken" ? Verdict::broken : Verdict::undecided;
}

StudyFolders::StudyFolders(StudyFile study, fs::path output, bool is_overwrite)
    : study_(std::move(study)),
      output_(std::move(output)),
      is_overwrite_(is_overwrite),
      points_(points_of(study_)),
      names_(names_of(study_, points_)) {
  require_usable(output_, true);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!study_.bisection) {
      (void)next_command(run_at(i));
      continue;
    }
    for (const double end : {study_.bisection->from, study_.bisection->to})
      (void)next_command(run_at(i, end));
  }
}

StudyRun StudyFolders::run_at(std::size_t point, std::optional<double> value) const {
  StudyRun run{.point = point, .value = value, .name = names_.at(point)};
  if (value)
    run.name += fmt::format("{}{}", run.name.empty() ? "" : "_",
                            name_of(study_.bisection->key, fmt::format("{}", *value)));
  return run;
}

fs::path StudyFolders::folder(const StudyRun& run) const { return output_ / "runs" / run.name; }

fs::path StudyFolders::log(const StudyRun& run) const {
  return output_ / "runs" / (run.name + ".log");
}

std::vector<std::string> StudyFolders::new_run(const StudyRun& run) const {
  std::vector<std::string> command{
      "run", study_.case_file.string(), "-o", folder(run).string(), "-q", "--overwrite"};
  for (const std::string& override : overrides_at(study_, points_[run.point], run.value)) {
    command.emplace_back("--set");
    command.push_back(override);
  }
  return command;
}

std::optional<std::vector<std::string>> StudyFolders::next_command(const StudyRun& run) const {
  const fs::path place = folder(run);
  const std::vector<std::string> overrides = overrides_at(study_, points_[run.point], run.value);
  const Case c = read_case(study_.case_file, overrides);
  const int most = study_.bisection ? study_.bisection->prolongations : 0;
  const auto state_after = [&](int prolongations) {
    if (prolongations == 0) return state_of_run(place, c);
    std::vector<std::string> longer = overrides;
    longer.push_back(fmt::format("time.end={}", prolonged_end(c, prolongations)));
    return state_of_run(place, read_case(study_.case_file, longer));
  };
  int prolongations = 0;
  RunState state = state_after(0);
  while (state == RunState::absent && prolongations < most) state = state_after(++prolongations);

  if (state == RunState::absent) {
    if (fs::exists(place / io::RunFiles::record) && !is_overwrite_)
      reject_input(
          "{}: holds a run of another case, of another version or of shapes that have changed "
          "since; give --overwrite to replace it, or another -o",
          place.string());
    return new_run(run);
  }
  if (state == RunState::unfinished) {
    if (io::checkpoints(place).empty()) return new_run(run);
    return std::vector<std::string>{"resume", place.string(), "-q"};
  }
  if (prolongations == most || result(run).ended != word_for(Ending::time)) return std::nullopt;
  return std::vector<std::string>{"resume", place.string(), "-q", "--until",
                                  fmt::format("{}", prolonged_end(c, prolongations + 1))};
}

StudyRunResult StudyFolders::result(const StudyRun& run) const {
  const fs::path place = folder(run);
  const RunTables tables = read_run_tables(place);
  StudyRunResult result{.ended = ending_of_run(place)};
  if (tables.history.rows.empty() || tables.drops.rows.empty())
    return {.failure = fmt::format("{}: its tables are empty", place.string())};
  result.events = tables.events.rows.size();
  result.t = tables.history.column("t").back();
  const std::vector<double> steps = tables.drops.column("step"), V = tables.drops.column("volume"),
                            L = tables.drops.column("L"), B = tables.drops.column("B"),
                            D = tables.drops.column("D"), angle = tables.drops.column("angle_deg");
  result.steps = std::llround(steps.back());
  std::size_t largest = steps.size() - 1;
  for (std::size_t row = 0; row < steps.size(); ++row) {
    if (steps[row] != steps.back()) continue;
    result.volumes.push_back(V[row]);
    if (V[row] > V[largest]) largest = row;
  }
  result.drops = result.volumes.size();
  result.L = L[largest];
  result.B = B[largest];
  result.D = D[largest];
  if (std::isfinite(angle[largest])) result.angle_deg = angle[largest];
  return result;
}

StudyRunResult StudyFolders::failure(const StudyRun& run, int status) const {
  std::string said = last_line(log(run));
  if (said.empty() && status > 128)
    said = fmt::format("it was ended by signal {} ({})", status - 128, strsignal(status - 128));
  if (said.empty()) said = fmt::format("it ended with status {}", status);
  return {.failure = said};
}

}  // namespace meniscus
