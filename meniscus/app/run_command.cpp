#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "meniscus/app/commands.hpp"
#include "meniscus/app/frames.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/app/live_view.hpp"
#include "meniscus/app/ranks.hpp"
#include "meniscus/app/run_crate.hpp"
#include "meniscus/app/run_record.hpp"
#include "meniscus/app/simulation.hpp"
#include "meniscus/app/wording.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/report.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

Evolution make_evolution(const Case& c, Scene scene) {
  Evolution evolution(std::move(scene), c.evolution, make_flow_solver(c), make_moving_mesh(c),
                      make_scalar_solver(c));
  evolution.set_listener(log_notice);
  return evolution;
}

/// The case with evolution and either flow solver shared by all ranks.
Case shared_case(Case c) {
  c.evolution.processes = linear::Processes::all;
  c.flow_solver.processes = linear::Processes::all;
  c.boundary_integral.processes = linear::Processes::all;
  return c;
}

/// Adds to a checkpoint what `resume` needs to rebuild the evolution.
std::function<void(Archive&)> case_description(const Case& c, const fs::path& folder) {
  return [text = case_toml(c),
          folder = fs::absolute(folder / ".").lexically_normal().string()](Archive& archive) {
    archive.texts["case/toml"] = text;
    archive.texts["case/folder"] = folder;
  };
}

Case case_of_checkpoint(const Archive& archive, const fs::path& checkpoint,
                        std::span<const std::string> overrides) {
  const auto text = archive.texts.find("case/toml"), folder = archive.texts.find("case/folder");
  if (text == archive.texts.end() || folder == archive.texts.end())
    reject_input("{}: not the checkpoint of a run", checkpoint.string());
  return shared_case(parse_case(text->second, checkpoint.string(), folder->second, overrides));
}

void finish(const Simulation& simulation, const RunRecord& record, const std::string& status) {
  on_first_rank([&] {
    record.write(simulation, status);
    write_report(simulation.directory().path());
    write_run_crate(simulation.directory().path());
  });
}

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
  progress.say(fmt::format("done: {} steps to t = {:g}; see {}/{}", simulation.evolution().step(),
                           simulation.evolution().t(), folder, io::RunFiles::page));
  return 0;
}

/// Copies rows and frames of a run to another folder, completely or not at all.
void copy_run(const fs::path& from, const fs::path& to) {
  (void)RunDirectory::create(to, false);
  try {
    for (const char* name : io::RunFiles::taken_along)
      if (fs::exists(from / name))
        fs::copy(from / name, to / name,
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  } catch (const fs::filesystem_error& error) {
    remove_run(to);
    throw RunFailure(error.what());
  }
}

/// Copies reference.csv of the case into the run's folder, where the page reads it. Removes the one
/// of a replaced run.
void copy_reference(const fs::path& case_folder, const fs::path& run_folder) {
  const fs::path source = case_folder / io::RunFiles::reference,
                 target = run_folder / io::RunFiles::reference;
  std::error_code ignored;
  if (fs::equivalent(fs::absolute(case_folder / "."), run_folder, ignored)) return;
  if (fs::exists(source, ignored))
    io::write_file(target, io::read_file(source));
  else
    fs::remove(target, ignored);
}

/// Refuses overrides of drops, domain and units: the checkpoint holds their evolved state.
void require_changeable(std::span<const std::string> overrides) {
  for (const std::string& override : overrides)
    for (const char* of_the_start : {"drop", "domain", "scale", "scalar"})
      if (override.starts_with(of_the_start))
        reject_input(
            "--set {}: drops, domain, scale and scalars are those of the checkpoint; what may be "
            "changed is in [flow], [interface], [time], [solver], [topology] and [output]",
            override);
}

/// Throws InvalidInput unless the checkpoint was taken in the given run.
void require_same_run(const Archive& archive, const fs::path& checkpoint, const fs::path& run) {
  const fs::path own = newest_checkpoint(run);
  const auto case_of = [](const Archive& a) {
    const auto text = a.texts.find("case/toml");
    return text == a.texts.end() ? std::string() : text->second;
  };
  if (case_of(archive) != case_of(io::read_archive(own)))
    reject_input("{}: not a checkpoint of the run in {}: its case differs", checkpoint.string(),
                 run.string());
}

/// Loads the state of a checkpoint. Throws InvalidInput, naming the file, where it does not fit.
void load_checkpoint(const Archive& archive, const fs::path& checkpoint, Evolution& evolution) {
  try {
    evolution.load(archive);
  } catch (const InvalidInput& damage) {
    reject_input("{}: {}", checkpoint.string(), damage.what());
  }
}

/// Throws InvalidInput when the smallest step of the case is too long for its initial shapes.
void require_first_step(const Evolution& evolution, const Case& c) {
  if (evolution.step_length() >= c.evolution.min_step || evolution.is_finished()) return;
  reject_input(
      "{}: time.min-step = {:g}: the first step would be {:.3g}, for the shortest edge and the "
      "tension",
      c.settings.source("time.min-step"), c.evolution.min_step, evolution.step_length());
}

int run(const RunArguments& arguments) {
  if (arguments.is_quiet) log::set_level(log::Level::error);
  const fs::path file(arguments.case_file);
  const Case c = shared_case(read_case(file, arguments.overrides));
  const std::string text = io::read_file(file);
  Scene scene = build_scene(c);
  const fs::path folder = arguments.output.empty() ? file.stem() : fs::path(arguments.output);
  require_usable(folder, arguments.is_overwrite);
  Evolution evolution = make_evolution(c, std::move(scene));
  if (const Report prepared = evolution.prepare(); !prepared.ok())
    throw RunFailure(fmt::format("{}: the initial mesh could not be made: {}",
                                 source_of_surface(c, evolution.scene(), prepared.fault->position),
                                 prepared.text()));
  require_first_step(evolution, c);
  if (arguments.set_up) arguments.set_up(evolution);
  check_field_names(evolution);
  const std::unique_ptr<LiveView> view = make_live_view(arguments.watch);
  // Nothing is written before the run can begin.
  std::optional<RunDirectory> directory;
  on_first_rank([&] {
    directory = RunDirectory::create(folder, arguments.is_overwrite, physics_of(evolution.scene()));
    try {
      copy_reference(file.parent_path(), folder);
    } catch (const std::exception&) {
      remove_unbegun_run(folder);
      throw;
    }
  });
  Simulation simulation(std::move(evolution), std::move(directory), c.output,
                        case_description(c, file.parent_path()));
  Progress progress(0.0, c.evolution.end, arguments.is_quiet);
  return simulate(simulation, RunRecord(c, arguments.case_file, text), progress, view.get());
}

int resume(const ResumeArguments& arguments) {
  if (arguments.is_quiet) log::set_level(log::Level::error);
  const fs::path source(arguments.directory);
  const fs::path checkpoint =
      arguments.from.empty() ? newest_checkpoint(source) : fs::path(arguments.from);
  const Archive archive = io::read_archive(checkpoint);
  require_changeable(arguments.overrides);
  std::vector<std::string> overrides = arguments.overrides;
  if (arguments.until) overrides.push_back(fmt::format("time.end={}", *arguments.until));
  const Case c = case_of_checkpoint(archive, checkpoint, overrides);
  Evolution evolution = make_evolution(c, build_surroundings(c));
  load_checkpoint(archive, checkpoint, evolution);
  if (arguments.until && *arguments.until < evolution.t())
    reject_input("--until {:g} lies before the checkpoint's t = {:g}", *arguments.until,
                 evolution.t());
  const fs::path folder = arguments.output.empty() ? source : fs::path(arguments.output);
  if (!arguments.output.empty()) {
    require_usable(folder, false);
    require_same_run(archive, checkpoint, source);
    on_first_rank([&] { copy_run(source, folder); });
  }
  const std::unique_ptr<LiveView> view = make_live_view(arguments.watch);
  RunRecord record(c, "", "");
  std::optional<RunDirectory> directory;
  on_first_rank([&] {
    record.go_on_from(folder / io::RunFiles::record);
    directory = RunDirectory::take_up(folder, evolution.step(), evolution.t(),
                                      physics_of(evolution.scene()));
  });
  Progress progress(evolution.t(), c.evolution.end, arguments.is_quiet);
  Simulation simulation(std::move(evolution), std::move(directory), c.output,
                        case_description(c, archive.texts.at("case/folder")));
  simulation.load_schedule(archive);
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
