#include "meniscus/app/run_parts.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <ranges>

#include <fmt/format.h>

#include "meniscus/app/ranks.hpp"
#include "meniscus/app/run_crate.hpp"
#include "meniscus/app/wording.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/report.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

Evolution make_evolution(const Case& c, Scene scene) {
  CaseSolvers solvers = make_solvers(c);
  Evolution evolution(std::move(scene), c.evolution, std::move(solvers.flow), make_moving_mesh(c),
                      std::move(solvers.scalars));
  evolution.set_listener(log_notice);
  return evolution;
}

/// Throws InvalidInput when the smallest step of the case is too long for its initial shapes.
void require_first_step(const Evolution& evolution, const Case& c) {
  if (evolution.step_length() >= c.evolution.min_step || evolution.is_finished()) return;
  reject_input(
      "{}: time.min-step = {:g}: the first step would be {:.3g}, for the shortest edge and the "
      "tension",
      c.settings.source("time.min-step"), c.evolution.min_step, evolution.step_length());
}

/// The newest checkpoint of a run that is not damaged; none where all are.
std::optional<Archive> newest_readable_checkpoint(const fs::path& run) {
  for (const auto& [step, file] : std::views::reverse(io::checkpoints(run))) {
    try {
      return io::read_archive(file);
    } catch (const InvalidInput&) {  // the one before it may be sound
    }
  }
  return std::nullopt;
}

/// The case of a checkpoint as if its run ended at its start: --until changes the end.
std::string case_but_for_end(const Archive& archive, const fs::path& checkpoint) {
  const std::array no_end{std::string("time.end=0.0")};
  return case_toml(case_of_checkpoint(archive, checkpoint, no_end));
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

/// Copies rows and frames of a run to another folder.
void copy_run(const fs::path& from, const fs::path& to) {
  try {
    for (const char* name : io::RunFiles::taken_along)
      if (fs::exists(from / name))
        fs::copy(from / name, to / name,
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  } catch (const fs::filesystem_error& error) {
    throw RunFailure(error.what());
  }
}

void remove_copy(const fs::path& copy) {
  remove_run(copy);
  std::error_code ignored;
  fs::remove(copy / io::RunFiles::reference, ignored);
  fs::remove(copy, ignored);  // if nothing else is there
}

}  // namespace

Case shared_case(Case c) {
  c.evolution.processes = linear::Processes::all;
  c.flow_solver.processes = linear::Processes::all;
  c.boundary_integral.processes = linear::Processes::all;
  c.volume_mesh.tetrahedra.processes = linear::Processes::all;
  return c;
}

WarningListener logged_and_kept(std::vector<std::string>& warnings) {
  return [&warnings](const std::string& text) {
    log_warning(text);
    warnings.push_back(text);
  };
}

Evolution begun_evolution(const Case& c, Scene scene) {
  Evolution evolution = make_evolution(c, std::move(scene));
  if (const Report prepared = evolution.prepare(); !prepared.ok())
    throw RunFailure(fmt::format("{}: the initial mesh could not be made: {}",
                                 source_of_surface(c, evolution.scene(), prepared.fault->position),
                                 prepared.text()));
  require_first_step(evolution, c);
  return evolution;
}

Evolution resumed_evolution(const Case& c, const Archive& archive, const fs::path& checkpoint) {
  Evolution evolution = make_evolution(c, build_surroundings(c));
  try {
    evolution.load(archive);
  } catch (const InvalidInput& damage) {
    reject_input("{}: {}", checkpoint.string(), damage.what());
  }
  return evolution;
}

Simulation::Description case_description(const Case& c, const fs::path& folder) {
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

void require_end_ahead(const Case& c, double t, std::span<const std::string> overrides,
                       std::string_view name) {
  const auto sets_end = [](const std::string& each) { return each.starts_with("time.end="); };
  if (std::ranges::none_of(overrides, sets_end) || c.evolution.end >= t) return;
  const double unit = c.settings.unit(schema::Dimension::time);
  const std::string_view word = c.settings.scale() ? " s" : "";
  reject_input("{} = {:g}{} lies before the checkpoint's t = {:g}{}", name, c.evolution.end * unit,
               word, t * unit, word);
}

void require_changeable(std::span<const std::string> overrides) {
  constexpr std::array of_the_checkpoint{"drop",
                                         "domain",
                                         "scale",
                                         "scalar",
                                         "matrix",
                                         "flow.capillary-number",
                                         "flow.reynolds-number",
                                         "flow.gravity"};
  for (const std::string& override : overrides)
    for (const char* kept : of_the_checkpoint)
      if (override.starts_with(kept))
        reject_input(
            "--set {}: liquids, drops, domain, scale and scalars are those of the checkpoint; what "
            "may be changed is flow.kind, flow.gradient, flow.schedule, and in [interface], "
            "[time], [solver], [topology] and [output]",
            override);
}

std::optional<RunDirectory> new_directory(const fs::path& folder, bool is_overwrite,
                                          const Evolution& evolution, const fs::path& case_folder) {
  std::optional<RunDirectory> directory;
  on_first_rank([&] {
    directory = RunDirectory::create(folder, is_overwrite, physics_of(evolution.scene()));
    try {
      copy_reference(case_folder, folder);
    } catch (const std::exception&) {
      remove_unbegun_run(folder);
      throw;
    }
  });
  return directory;
}

std::optional<RunDirectory> taken_up_run(const fs::path& source, const fs::path& folder,
                                         const Evolution& evolution, RunRecord& record) {
  std::optional<RunDirectory> directory;
  on_first_rank([&] {
    const bool is_copy = folder != source;
    if (is_copy) (void)RunDirectory::create(folder, false);
    try {
      if (is_copy) copy_run(source, folder);
      record.go_on_from(folder);
      directory = RunDirectory::take_up(folder, evolution.step(), evolution.t(),
                                        physics_of(evolution.scene()));
    } catch (const std::exception&) {
      if (is_copy) remove_copy(folder);
      throw;
    }
  });
  return directory;
}

void require_same_run(const Archive& archive, const fs::path& checkpoint, const fs::path& run) {
  const std::optional<Archive> own = newest_readable_checkpoint(run);
  if (own && case_but_for_end(archive, checkpoint) != case_but_for_end(*own, run))
    reject_input("{}: not a checkpoint of the run in {}: its case differs", checkpoint.string(),
                 run.string());
}

void finish(const Simulation& simulation, const RunRecord& record, const std::string& status) {
  on_first_rank([&] {
    record.write(simulation, status);
    write_report(simulation.directory().path());
    write_run_crate(simulation.directory().path());
  });
}

}  // namespace meniscus
