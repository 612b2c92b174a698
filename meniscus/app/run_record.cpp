#include "meniscus/app/run_record.hpp"

#include <array>
#include <cmath>
#include <span>

#include <fmt/chrono.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "meniscus/app/ranks.hpp"
#include "meniscus/app/run_json.hpp"
#include "meniscus/app/wording.hpp"
#include "meniscus/core/version.hpp"
#include "meniscus/evolve/constants.hpp"
#include "meniscus/evolve/stop_rules.hpp"
#include "meniscus/flow/fem/constants.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/volume_corrections.hpp"
#include "meniscus/surface/constants.hpp"
#include "meniscus/topology/constants.hpp"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

std::string now_utc() {
  return fmt::format(
      "{:%Y-%m-%dT%H:%M:%SZ}",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// The constants that decide physics but are not in the case file, by room.
Json constants() {
  Json rooms = Json::object();
  const auto add = [&](const char* room, std::span<const NamedConstant> list) {
    for (const NamedConstant& constant : list) rooms[room][constant.name] = constant.value;
  };
  add("surface", kSurfaceConstants);
  add("topology", kTopologyConstants);
  add("flow/fem", fem::kConstants);
  add("evolve", kEvolveConstants);
  add("evolve", kStopConstants);
  return rooms;
}

/// Of a case with [scale] the numbers that its keys give in SI units or not at all.
std::string dimensionless_json(const Case& c) {
  if (!c.settings.scale()) return {};
  const Json Ca = std::isfinite(c.Ca) ? Json(c.Ca) : Json("inf");
  return Json{{"end", c.evolution.end}, {"Ca", Ca}, {"Re", c.reynolds}}.dump();
}

}  // namespace

RunRecord::RunRecord(const Case& c, std::string case_file, std::string case_text,
                     std::vector<std::string> warnings, std::map<std::string, std::string> inputs)
    : case_file_(std::move(case_file)),
      case_text_(std::move(case_text)),
      case_json_(case_json(c)),
      inputs_(std::move(inputs)),
      dimensionless_json_(dimensionless_json(c)),
      title_(c.title),
      started_(now_utc()),
      warnings_(std::move(warnings)) {}

void RunRecord::go_on_from(const std::filesystem::path& folder) {
  const Json before = read_run_json(folder);
  started_ = member(before, "started", started_);
  case_file_ = member(before, "case_file", case_file_);
  case_text_ = member(before, "case_text", case_text_);
  wall_before_ = member(before, "wall_seconds", 0.0);
  warnings_ = member(before, "warnings", warnings_);
  inputs_ = member(before, "inputs", decltype(inputs_)());
  if (const Json changes = member(before, "changes", Json()); changes.is_array())
    changes_json_ = changes.dump();
  const Json seconds = member(before, "seconds", Json::object());
  if (!seconds.is_object()) return;
  for (const auto& [phase, spent] : seconds.items())
    if (spent.is_number()) seconds_before_.emplace_back(phase, spent);
}

void RunRecord::change_case(const Case& c, std::int64_t step, double t,
                            const std::vector<std::string>& settings) {
  Json changes = changes_json_.empty() ? Json::array() : Json::parse(changes_json_);
  changes.push_back({{"step", step}, {"t", t}, {"set", settings}});
  changes_json_ = changes.dump();
  case_json_ = case_json(c);
  dimensionless_json_ = dimensionless_json(c);
}

void RunRecord::write(const Simulation& simulation, const std::string& status) const {
  Json seconds = Json::object();
  for (const auto& [phase, spent] : simulation.seconds()) seconds[phase] = spent;
  for (const auto& [phase, spent] : seconds_before_)
    seconds[phase] = seconds.value(phase, 0.0) + spent;
  Json warnings = warnings_;
  for (const Notice& notice : simulation.evolution().notices()) warnings.push_back(text_of(notice));
  const std::filesystem::path& folder = simulation.directory().path();
  const auto corrections =
      report::volume_correction_sum(io::read_table(folder / io::RunFiles::drops));
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  const FieldExcess& excess = simulation.evolution().state().field_excess;
  Json record{{"program", "meniscus"},
              {"version", version_string},
              {"commit", commit_string},
              {"title", title_},
              {"status", status},
              {"case_file", case_file_},
              {"case_text", case_text_},
              {"case", Json::parse(case_json_)},
              {"constants", constants()},
              {"host", host_name()},
              {"ranks", num_ranks()},
              {"started", started_},
              {"finished", now_utc()},
              {"wall_seconds", wall_before_ + wall},
              {"seconds", seconds},
              {"steps", simulation.evolution().step()},
              {"t", simulation.evolution().t()},
              {"field_excess", {{"above", excess.above}, {"below", excess.below}}},
              {"volume_correction_sum", corrections.value_or(0.0)},
              {"warnings", warnings}};
  if (!inputs_.empty()) record["inputs"] = inputs_;
  if (simulation.end()) record["ended"] = word_for(simulation.end()->ending);
  if (!dimensionless_json_.empty()) record["dimensionless"] = Json::parse(dimensionless_json_);
  if (!changes_json_.empty()) record["changes"] = Json::parse(changes_json_);
  simulation.directory().write_text(io::RunFiles::record, file_text(record));
}

}  // namespace meniscus
