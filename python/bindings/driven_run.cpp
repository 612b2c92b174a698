#include "python/bindings/driven_run.hpp"

#include <utility>

#include <fmt/format.h>

#include "meniscus/app/case_inputs.hpp"
#include "meniscus/app/ranks.hpp"
#include "meniscus/app/run_parts.hpp"
#include "meniscus/app/run_tables.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus::python {
namespace {

namespace fs = std::filesystem;

void append_file(const fs::path& file, RunTable& table) {
  for (const std::vector<std::string>& row : io::read_table(file).rows)
    table.rows.emplace_back(row.begin(), row.end());
}

}  // namespace

DrivenRun::DrivenRun(PythonCase c, std::optional<fs::path> folder, Simulation simulation,
                     RunRecord record)
    : case_(std::move(c)),
      folder_(std::move(folder)),
      simulation_(std::move(simulation)),
      record_(std::move(record)),
      physics_(physics_of(simulation_.evolution().scene())) {
  tables_.history.columns = history_names(physics_);
  tables_.drops.columns = drop_names(physics_);
  tables_.events.columns = event_names(physics_);
}

std::unique_ptr<DrivenRun> DrivenRun::begin(PythonCase given, const std::optional<fs::path>& folder,
                                            bool is_overwrite) {
  if (!is_first_rank()) log::set_level(log::Level::error);
  const Case c = shared_case(given.parsed());
  std::map<std::string, std::string> inputs = case_inputs(c);
  std::vector<std::string> warnings;
  Scene scene = build_scene(c, logged_and_kept(warnings));
  if (folder) require_usable(*folder, is_overwrite);
  Evolution evolution = begun_evolution(c, std::move(scene));
  check_field_names(evolution);
  RunRecord record(c, given.file(), given.text(), warnings, std::move(inputs));
  std::optional<RunDirectory> directory;
  if (folder) directory = new_directory(*folder, is_overwrite, evolution, given.folder());
  Simulation simulation(std::move(evolution), std::move(directory), c.output,
                        case_description(c, given.folder()));
  simulation.stop_when(c.stop);
  std::unique_ptr<DrivenRun> run(
      new DrivenRun(std::move(given), folder, std::move(simulation), std::move(record)));
  run->start();
  return run;
}

std::unique_ptr<DrivenRun> DrivenRun::resume(const fs::path& source,
                                             const std::optional<fs::path>& output,
                                             const std::vector<std::string>& settings) {
  if (!is_first_rank()) log::set_level(log::Level::error);
  std::error_code ignored;
  const bool is_run = fs::is_directory(source, ignored);
  const fs::path checkpoint = is_run ? newest_checkpoint(source) : source;
  const Archive archive = io::read_archive(checkpoint);
  require_changeable(settings);
  const Case c = case_of_checkpoint(archive, checkpoint, settings);
  PythonCase given(archive.texts.at("case/toml"), checkpoint.string(),
                   archive.texts.at("case/folder"), settings);
  Evolution evolution = resumed_evolution(c, archive, checkpoint);
  require_end_ahead(c, evolution.t(), settings, "time.end");
  const bool goes_on = is_run && !output;
  const std::optional<fs::path> folder = goes_on ? source : output;
  RunRecord record(c, given.file(), given.text());
  std::optional<RunDirectory> directory;
  if (output) require_usable(*output, false);
  if (output && !is_run) directory = new_directory(*output, false, evolution, given.folder());
  if (is_run) directory = taken_up_run(source, *folder, evolution, record);
  Simulation simulation(std::move(evolution), std::move(directory), c.output,
                        case_description(c, given.folder()));
  simulation.stop_when(c.stop);
  simulation.load(archive);
  std::unique_ptr<DrivenRun> run(
      new DrivenRun(std::move(given), folder, std::move(simulation), std::move(record)));
  if (is_run) run->read_earlier_rows();
  run->start();
  return run;
}

void DrivenRun::read_earlier_rows() {
  append_file(*folder_ / io::RunFiles::history, tables_.history);
  append_file(*folder_ / io::RunFiles::drops, tables_.drops);
  append_file(*folder_ / io::RunFiles::events, tables_.events);
}

void DrivenRun::start() {
  try {
    write_record("running");
    record_state();
  } catch (const std::exception& failure) {
    note_failure(failure);
    if (folder_) on_first_rank([&] { remove_unbegun_run(*folder_); });
    throw;
  }
}

void DrivenRun::record_state() {
  surfaces_.reset();
  volume_.reset();
  settings_at_step_ = 0;
  const HistoryRow row =
      simulation_.record_state([&](const HistoryRow& history, const std::vector<DropRow>& drops) {
        add_rows(history, drops);
      });
  if (!is_first_rank()) add_rows(row, evolution().moving_drop_rows());
  if (simulation_.has_ended()) end("done");
}

void DrivenRun::add_rows(const HistoryRow& history, const std::vector<DropRow>& drops) {
  tables_.history.rows.push_back(history_cells(history, physics_));
  for (const DropRow& row : drops)
    tables_.drops.rows.push_back(drop_cells({history.step, history.t, row}, physics_));
  for (const TopologyEvent& event : evolution().events())
    tables_.events.rows.push_back(event_cells({history.step, history.t, event}, history.kinetic));
}

void DrivenRun::require_going() const {
  if (has_failed()) throw RunFailure("the run has failed: " + failure_);
  if (simulation_.has_ended())
    throw RunFailure(fmt::format("the run is at its end, t = {:g}", evolution().t()));
}

void DrivenRun::step() {
  require_going();
  try {
    if (std::exchange(is_stopped_, false)) write_record("running");
    simulation_.advance();
    record_state();
  } catch (const std::exception& failure) {
    note_failure(failure);
    throw;
  }
}

void DrivenRun::stop() {
  if (has_failed() || simulation_.has_ended()) return;
  simulation_.write_checkpoint();
  end("stopped");
  is_stopped_ = true;
}

void DrivenRun::write_checkpoint(const fs::path& file) { simulation_.write_checkpoint(file); }

void DrivenRun::set_flow(const std::vector<std::string>& settings) {
  require_going();
  PythonCase changed = case_;
  changed.replace_last(settings_at_step_, settings);
  const Case c = shared_case(changed.parsed());
  const Scene surroundings = build_surroundings(c);
  record_.change_case(c, evolution().step(), evolution().t(), settings);
  case_ = std::move(changed);
  settings_at_step_ = settings.size();
  surfaces_.reset();
  volume_.reset();
  try {
    simulation_.set_surroundings(surroundings, case_description(c, case_.folder()));
    write_record("running");
    is_stopped_ = false;
  } catch (const std::exception& failure) {
    note_failure(failure);
    throw;
  }
}

std::shared_ptr<const SurfaceSnapshot> DrivenRun::surfaces() {
  if (!surfaces_) surfaces_ = surface_snapshot(evolution());
  return surfaces_;
}

std::shared_ptr<const VolumeSnapshot> DrivenRun::volume() {
  if (!volume_) volume_ = volume_snapshot(evolution());
  return volume_;
}

void DrivenRun::write_record(const std::string& status) {
  if (folder_) on_first_rank([&] { record_.write(simulation_, status); });
}

void DrivenRun::end(const std::string& status) {
  if (folder_) finish(simulation_, record_, status);
}

/// Remembers why the run cannot go on, as do its files.
void DrivenRun::note_failure(const std::exception& failure) {
  require_all_failed(failure);
  failure_ = failure.what();
  try {
    end("failed: " + failure_);
  } catch (const std::exception&) {
    log::warning("neither run.json nor the report could be brought up to date");
  }
}

}  // namespace meniscus::python
