#include "meniscus/app/run_directory.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "meniscus/app/frames.hpp"
#include "meniscus/app/run_crate.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

using io::RunFiles;

constexpr int kCheckpointsKept = 2;

std::vector<io::PvdEntry> frames_before(const fs::path& pvd, double t) {
  if (!fs::exists(pvd)) return {};
  std::vector<io::PvdEntry> entries = io::read_pvd(pvd);
  std::erase_if(entries, [&](const io::PvdEntry& entry) { return entry.t >= t; });
  return entries;
}

/// The steps of the events in a table and the steps before them. Their checkpoints are kept.
std::set<std::int64_t> steps_around_events(const fs::path& events) {
  std::set<std::int64_t> steps;
  if (!fs::exists(events)) return steps;
  for (const double step : io::read_table(events).column("step")) {
    steps.insert(std::llround(step));
    steps.insert(std::llround(step) - 1);
  }
  return steps;
}

std::string volume_file(const Evolution& evolution) {
  return fmt::format("{0}/{0}-{1:06}.vtu", RunFiles::volume_folder, evolution.step());
}

/// The columns of a run's tables, by file.
std::map<std::string, std::vector<std::string>> columns_of(const RunPhysics& physics) {
  return {{RunFiles::history, history_names(physics)},
          {RunFiles::drops, drop_names(physics)},
          {RunFiles::events, event_names(physics)},
          {RunFiles::timing, timing_columns(!physics.scalars.empty())}};
}

io::TableWriter table(const fs::path& folder, const std::string& name, const RunPhysics& physics,
                      std::optional<std::int64_t> first_step) {
  const fs::path file = folder / name;
  const std::vector<std::string> columns = columns_of(physics).at(name);
  return first_step && fs::exists(file) ? io::TableWriter(file, columns, *first_step)
                                        : io::TableWriter(file, columns);
}

/// Removes the frames of a run from their folder, and the folder if nothing else is there.
void remove_frames(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with(name + "-") && file.find(".vt") != std::string::npos)
      frames.push_back(entry.path());
  }
  for (const fs::path& frame : frames) fs::remove(frame);
  if (fs::is_empty(folder)) fs::remove(folder);
}

}  // namespace

RunDirectory::RunDirectory(FolderLock lock, fs::path path, RunPhysics physics,
                           std::optional<std::int64_t> first_step)
    : lock_(std::move(lock)),
      path_(std::move(path)),
      physics_(std::move(physics)),
      kept_steps_(first_step ? steps_around_events(path_ / RunFiles::events)
                             : std::set<std::int64_t>{}),
      history_(table(path_, RunFiles::history, physics_, first_step)),
      drops_(table(path_, RunFiles::drops, physics_, first_step)),
      events_(table(path_, RunFiles::events, physics_, first_step)),
      timing_(table(path_, RunFiles::timing, physics_, first_step)) {}

RunDirectory RunDirectory::create(const fs::path& path, bool overwrite, RunPhysics physics) {
  require_usable(path, overwrite);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) reject_input("output folder {} cannot be made: {}", path.string(), error.message());
  FolderLock lock(path);
  if (holds_run(path)) remove_run(path);
  try {
    return RunDirectory(std::move(lock), path, std::move(physics), std::nullopt);
  } catch (const std::exception&) {
    remove_unbegun_run(path);
    throw;
  }
}

RunDirectory RunDirectory::take_up(const fs::path& path, std::int64_t first_step, double t,
                                   RunPhysics physics) {
  FolderLock lock(path);
  // All is read before a table is cut.
  std::vector<io::PvdEntry> surfaces = frames_before(path / RunFiles::surface_frames, t),
                            volumes = frames_before(path / RunFiles::volume_frames, t);
  for (const auto& [name, columns] : columns_of(physics))
    if (fs::exists(path / name)) io::require_rows(path / name, columns, first_step);
  RunDirectory directory(std::move(lock), path, std::move(physics), first_step);
  directory.surface_frames_ = std::move(surfaces);
  directory.volume_frames_ = std::move(volumes);
  return directory;
}

void RunDirectory::add_rows(const HistoryRow& history, const std::vector<DropRow>& drops) {
  MENISCUS_ASSERT(history.drops == static_cast<int>(drops.size()), "{} rows of {} drops",
                  drops.size(), history.drops);
  for (const DropRow& row : drops) drops_.add(drop_cells({history.step, history.t, row}, physics_));
  history_.add(history_cells(history, physics_));
}

void RunDirectory::add_events(const HistoryRow& history, const std::vector<TopologyEvent>& events) {
  for (const TopologyEvent& event : events)
    events_.add(event_cells({history.step, history.t, event}, history.kinetic));
  if (!events.empty()) kept_steps_.insert({history.step - 1, history.step});
}

void RunDirectory::add_timing(std::int64_t step, double t, const PhaseSeconds& seconds) {
  timing_.add(timing_row(step, t, seconds, !physics_.scalars.empty()));
}

void RunDirectory::add_surface_frame(const Evolution& evolution) {
  fs::create_directories(path_ / RunFiles::surface_folder);
  const std::string name =
      fmt::format("{0}/{0}-{1:06}", RunFiles::surface_folder, evolution.step());
  const fs::path file = write_surface_frame(path_ / name, evolution);
  surface_frames_.push_back({evolution.t(), name + file.extension().string()});
  io::write_pvd(path_ / RunFiles::surface_frames, surface_frames_);
}

fs::path RunDirectory::begin_volume_frame(const Evolution& evolution) {
  fs::create_directories(path_ / RunFiles::volume_folder);
  return path_ / volume_file(evolution);
}

void RunDirectory::list_volume_frame(const Evolution& evolution) {
  volume_frames_.push_back({evolution.t(), volume_file(evolution)});
  io::write_pvd(path_ / RunFiles::volume_frames, volume_frames_);
}

void RunDirectory::write_checkpoint(const Archive& archive, std::int64_t step) {
  io::write_archive(path_ / io::checkpoint_name(step), archive);
  const auto all = io::checkpoints(path_);
  for (std::size_t i = 0; i + kCheckpointsKept < all.size(); ++i)
    if (!kept_steps_.contains(all[i].first)) fs::remove(all[i].second);
}

void RunDirectory::write_text(const std::string& name, const std::string& text) const {
  io::write_file(path_ / name, text);
}

void require_usable(const fs::path& path, bool overwrite) {
  std::error_code ignored;
  for (fs::path part = fs::absolute(path); part.has_relative_path(); part = part.parent_path()) {
    if (!fs::exists(part, ignored)) continue;
    if (!fs::is_directory(part, ignored))
      reject_input("output folder {}: {} is a file", path.string(), part.string());
    break;
  }
  if (overwrite) return;
  if (holds_run(path))
    reject_input("output folder {} holds a run already; give --overwrite or another -o",
                 path.string());
  for (const char* name : RunFiles::written)
    if (fs::exists(path / name, ignored) && !fs::is_directory(path / name, ignored))
      reject_input("output folder {} holds {}, and no run; give --overwrite or another -o",
                   path.string(), name);
}

void remove_run(const fs::path& path) {
  for (const char* name : RunFiles::written) {
    if (!fs::is_directory(path / name))
      fs::remove(path / name);
    else
      remove_frames(path / name, name);
  }
  for (const auto& [step, file] : io::checkpoints(path)) fs::remove(file);
}

void remove_unbegun_run(const fs::path& path) {
  if (io::checkpoints(path).empty()) remove_run(path);
}

bool holds_run(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return false;
  return fs::exists(path / RunFiles::history, error) ||
         fs::exists(path / RunFiles::record, error) || !io::checkpoints(path).empty();
}

fs::path newest_checkpoint(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) reject_input("{} is not the folder of a run", path.string());
  const auto all = io::checkpoints(path);
  if (all.empty()) reject_input("{} holds no checkpoint to go on from", path.string());
  return all.back().second;
}

}  // namespace meniscus
