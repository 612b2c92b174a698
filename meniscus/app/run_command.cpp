#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "meniscus/app/case_inputs.hpp"
#include "meniscus/app/commands.hpp"
#include "meniscus/app/frames.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/app/live_view.hpp"
#include "meniscus/app/ranks.hpp"
#include "meniscus/app/run_parts.hpp"
#include "meniscus/app/run_record.hpp"
#include "meniscus/app/simulation.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

/// The live view, if requested. It listens before the run begins, so that a failure leaves nothing
/// written.
std::unique_ptr<LiveView> make_live_view(const WatchArguments& watch) {
  std::unique_ptr<LiveView> view;
  on_first_rank([&] {
    if (watch.is_on) view = std::make_unique<LiveView>(WatchAddress{watch.address, watch.port});
  });
  return view;
}

void begin_live_view(LiveView* view, Simulation& simulation, const Progress& progress) {
  if (view == nullptr) return;
  view->begin(simulation.directory().path());
  view->update(simulation.directory());
  simulation.set_observer([view](const RunDirectory& directory) { view->update(directory); });
  progress.say(fmt::format("watch the run at {}", view->url()));
}

/// Runs to the end and updates run.json and the report, whatever the outcome.
int simulate(Simulation& simulation, const RunRecord& record, Progress& progress, LiveView* view) {
  watch_for_interrupts();
  std::string folder;
  try {
    on_first_rank([&] {
      folder = simulation.directory().path().string();
      record.write(simulation, "running");
      begin_live_view(view, simulation, progress);
    });
    const Outcome outcome = simulation.run(progress);
    progress.close();
    const std::string status = outcome == Outcome::done ? "done" : "stopped";
    finish(simulation, record, status);
    if (view != nullptr) view->end(status);
    if (outcome == Outcome::stopped) {
      progress.say(fmt::format("stopped at t = {:g}; go on with: meniscus resume {}",
                               simulation.evolution().t(), folder));
      return 1;
    }
  } catch (const std::exception& failure) {
    progress.close();
    require_all_failed(failure);
    try {
      finish(simulation, record, fmt::format("failed: {}", failure.what()));
    } catch (const std::exception&) {
      log::warning(
          "run.json, the report and ro-crate-metadata.json could not all be brought up to date");
    }
    if (view != nullptr) view->end("failed");
    if (!folder.empty()) remove_unbegun_run(folder);
    throw;
  }
  const std::string why = simulation.end() ? simulation.end()->text : "";
  progress.say(fmt::format("done: {} steps to t = {:g}{}{}; see {}/{}",
                           simulation.evolution().step(), simulation.evolution().t(),
                           why.empty() ? "" : ": ", why, folder, io::RunFiles::page));
  return 0;
}

int run(const RunArguments& arguments) {
  if (arguments.is_quiet) log::set_level(log::Level::error);
  const fs::path file(arguments.case_file);
  const Case c = shared_case(read_case(file, arguments.overrides));
  const std::string text = io::read_file(file);
  const std::map<std::string, std::string> inputs = case_inputs(c);
  std::vector<std::string> warnings;
  Scene scene = build_scene(c, logged_and_kept(warnings));
  const fs::path folder = arguments.output.empty() ? file.stem() : fs::path(arguments.output);
  require_usable(folder, arguments.is_overwrite);
  Evolution evolution = begun_evolution(c, std::move(scene));
  if (arguments.set_up) arguments.set_up(evolution);
  check_field_names(evolution);
  const std::unique_ptr<LiveView> view = make_live_view(arguments.watch);
  // Nothing is written before the run can begin.
  RunRecord record(c, arguments.case_file, text, warnings, inputs);
  std::optional<RunDirectory> directory =
      new_directory(folder, arguments.is_overwrite, evolution, file.parent_path());
  Simulation simulation(std::move(evolution), std::move(directory), c.output,
                        case_description(c, file.parent_path()));
  simulation.stop_when(c.stop);
  Progress progress(0.0, c.evolution.end, arguments.is_quiet);
  return simulate(simulation, record, progress, view.get());
}

/// A checkpoint of a run. Where the newest one is damaged the line names the one before it.
Archive read_checkpoint(const fs::path& checkpoint) {
  try {
    return io::read_archive(checkpoint);
  } catch (const InvalidInput& error) {
    const auto all = io::checkpoints(checkpoint.parent_path());
    if (all.size() < 2 || all.back().second.filename() != checkpoint.filename()) throw;
    reject_input("{}; go on from the one before it with --from {} -o NEW", error.what(),
                 all[all.size() - 2].second.string());
  }
}

int resume(const ResumeArguments& arguments) {
  if (arguments.is_quiet) log::set_level(log::Level::error);
  const fs::path source(arguments.directory);
  const fs::path checkpoint =
      arguments.from.empty() ? newest_checkpoint(source) : fs::path(arguments.from);
  const Archive archive = read_checkpoint(checkpoint);
  require_changeable(arguments.overrides);
  std::vector<std::string> overrides = arguments.overrides;
  if (arguments.until) {
    if (!(*arguments.until >= 0.0) || !std::isfinite(*arguments.until))
      reject_input("--until = {:g} must be finite and at least 0", *arguments.until);
    overrides.push_back(fmt::format("time.end={}", *arguments.until));
  }
  const Case c = case_of_checkpoint(archive, checkpoint, overrides);
  Evolution evolution = resumed_evolution(c, archive, checkpoint);
  require_end_ahead(c, evolution.t(), overrides, arguments.until ? "--until" : "time.end");
  const fs::path folder = arguments.output.empty() ? source : fs::path(arguments.output);
  if (!arguments.output.empty()) {
    require_usable(folder, false);
    require_same_run(archive, checkpoint, source);
  }
  const std::unique_ptr<LiveView> view = make_live_view(arguments.watch);
  RunRecord record(c, "", "");
  std::optional<RunDirectory> directory = taken_up_run(source, folder, evolution, record);
  Progress progress(evolution.t(), c.evolution.end, arguments.is_quiet);
  Simulation simulation(std::move(evolution), std::move(directory), c.output,
                        case_description(c, archive.texts.at("case/folder")));
  simulation.stop_when(c.stop);
  simulation.load(archive);
  return simulate(simulation, record, progress, view.get());
}

}  // namespace

int run_command(const RunArguments& arguments) {
  return on_all_ranks([&] { return run(arguments); });
}

int resume_command(const ResumeArguments& arguments) {
  return on_all_ranks([&] { return resume(arguments); });
}

}  // namespace meniscus
