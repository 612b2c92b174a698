#include "meniscus/report/run_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include <nlohmann/json.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using io::RunFiles;

/// A value as text, as a case file shows it.
std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  return value.dump();
}

/// The value of a key as text; empty when absent.
std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? std::string() : value_text(*found);
}

/// Walks a nested object down to its values: {"flow": {"kind": …}} gives "flow.kind".
void flatten(const Json& value, const std::string& path,
             std::vector<std::pair<std::string, std::string>>& values) {
  const bool is_list_of_tables = value.is_array() && !value.empty() && value.front().is_object();
  if (!value.is_object() && !is_list_of_tables) {
    values.emplace_back(path, value_text(value));
    return;
  }
  std::size_t index = 0;
  for (const auto& [key, inner] : value.items()) {
    const std::string step =
        is_list_of_tables ? fmt::format("[{}]", index++) : (path.empty() ? key : "." + key);
    flatten(inner, path + step, values);
  }
}

RunFacts parse_facts(const Json& json) {
  RunFacts facts;
  facts.title = text_of(json, "title");
  facts.status = text_of(json, "status");
  facts.program = text_of(json, "program");
  facts.version = text_of(json, "version");
  facts.commit = text_of(json, "commit");
  facts.case_file = text_of(json, "case_file");
  facts.case_text = text_of(json, "case_text");
  facts.host = text_of(json, "host");
  facts.started = text_of(json, "started");
  facts.finished = text_of(json, "finished");
  facts.ranks = text_of(json, "ranks");
  facts.steps = text_of(json, "steps");
  facts.t = text_of(json, "t");
  const Json none = Json::object();
  const Json numbers = json.value("dimensionless", none);
  for (const auto& [name, value] : numbers.items())
    facts.numbers.emplace_back(  // quotients of the case's numbers, with their roundoff
        name, value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : value_text(value));
  const Json spent = json.value("seconds", none), warnings = json.value("warnings", Json::array());
  for (const auto& [phase, seconds] : spent.items()) {
    if (seconds.is_number()) facts.seconds.emplace_back(phase, seconds.get<double>());
  }
  const auto add = [](double sum, const auto& phase) { return sum + phase.second; };
  const double in_phases = std::accumulate(facts.seconds.begin(), facts.seconds.end(), 0.0, add);
  const auto wall = json.find("wall_seconds");
  const bool has_wall = wall != json.end() && wall->is_number();
  facts.wall_seconds = has_wall ? wall->get<double>() : in_phases;
  flatten(json.value("case", none), "", facts.case_values);
  for (const Json& warning : warnings) {
    facts.warnings.push_back(value_text(warning));
  }
  return facts;
}

void load_facts(RunData& run) {
  const fs::path path = run.folder / RunFiles::record;
  if (!fs::exists(path)) return;
  try {
    const Json json = Json::parse(io::read_file(path));
    if (!json.is_object()) throw std::runtime_error("not an object");
    run.facts = parse_facts(json);
  } catch (const std::exception& error) {
    run.facts = {};
    run.faults.push_back(fmt::format("{} cannot be read: {}", RunFiles::record, error.what()));
  }
}

std::optional<io::Table> load_table(RunData& run, const char* name,
                                    io::Table (*read)(const fs::path&) = io::read_table) {
  if (!fs::exists(run.folder / name)) return std::nullopt;
  try {
    return read(run.folder / name);
  } catch (const InvalidInput& error) {
    run.faults.emplace_back(error.what());
    return std::nullopt;
  }
}

std::vector<io::PvdEntry> load_frames(RunData& run, const char* name) {
  std::vector<io::PvdEntry> frames;
  if (!fs::exists(run.folder / name)) return frames;
  try {
    frames = io::read_pvd(run.folder / name);
    std::ranges::stable_sort(frames, {}, &io::PvdEntry::t);
  } catch (const InvalidInput& error) {
    run.faults.emplace_back(error.what());
  }
  return frames;
}

/// The value of a key in a list; empty if absent.
std::string value_in(const std::vector<std::pair<std::string, std::string>>& list,
                     const std::string& key) {
  const auto found = std::ranges::find(list, key, &std::pair<std::string, std::string>::first);
  return found == list.end() ? std::string() : found->second;
}

}  // namespace

std::string RunFacts::case_value(const std::string& key) const {
  return value_in(case_values, key);
}

std::string RunFacts::dimensionless(const std::string& number, const std::string& key) const {
  return numbers.empty() ? case_value(key) : value_in(numbers, number);
}

bool RunFacts::is_quiescent() const {
  if (case_value("flow.kind") != "quiescent") return false;
  // Where walls or a schedule have a rate, Ca may be another; [scale] gives it with roundoff.
  const std::string Ca = dimensionless("Ca", "flow.capillary-number");
  return Ca.empty() || std::abs(std::strtod(Ca.c_str(), nullptr) - 1.0) < 1e-9;
}

RunData load_run(const fs::path& folder) {
  if (!fs::exists(folder / RunFiles::record) && !fs::exists(folder / RunFiles::history)) {
    reject_input("{}: not the folder of a run; it holds neither {} nor {}", folder.string(),
                 RunFiles::record, RunFiles::history);
  }
  RunData run;
  run.folder = folder;
  load_facts(run);
  run.history = load_table(run, RunFiles::history);
  run.drops = load_table(run, RunFiles::drops);
  run.events = load_table(run, RunFiles::events);
  run.timing = load_table(run, RunFiles::timing);
  run.reference = load_table(run, RunFiles::reference, io::read_commented_table);
  run.frames = load_frames(run, RunFiles::surface_frames);
  run.volume_frames = load_frames(run, RunFiles::volume_frames);
  return run;
}

}  // namespace meniscus::report
