#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "meniscus/app/folder_lock.hpp"
#include "meniscus/app/run_tables.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/io/table.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus {

/// What a run leaves (docs/notation.md): the tables, frames, checkpoints and run.json of one
/// folder.
class RunDirectory {
 public:
  /// Makes a folder for a new run. Throws InvalidInput when the path cannot be a folder or holds a
  /// run already; with `overwrite` the files of that run are removed first. As long as it lives no
  /// other program can take the folder: here and in `take_up` that throws InvalidInput.
  static RunDirectory create(const std::filesystem::path& path, bool overwrite);
  /// Takes up a run from the state at `first_step`, time t: rows and frames from there on are
  /// dropped, to be made again.
  static RunDirectory take_up(const std::filesystem::path& path, std::int64_t first_step, double t);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// What surface.pvd and volume.pvd name.
  [[nodiscard]] const std::vector<io::PvdEntry>& surface_frames() const { return surface_frames_; }
  [[nodiscard]] const std::vector<io::PvdEntry>& volume_frames() const { return volume_frames_; }

  void add_rows(const HistoryRow& history, const std::vector<DropRow>& drops);
  void add_events(std::int64_t step, double t, const std::vector<TopologyEvent>& events);
  void add_timing(std::int64_t step, double t, const PhaseSeconds& seconds);
  void add_surface_frame(const Evolution& evolution);
  void add_volume_frame(const Evolution& evolution);
  /// Writes checkpoint-<step>.h5 and removes all but the last two and those around events: of the
  /// steps in events.csv and the ones before.
  void write_checkpoint(const Archive& archive, std::int64_t step);
  void write_text(const std::string& name, const std::string& text) const;

 private:
  RunDirectory(FolderLock lock, std::filesystem::path path, std::optional<std::int64_t> first_step);

  FolderLock lock_;
  std::filesystem::path path_;
  std::set<std::int64_t> kept_steps_;  // of checkpoints around events
  io::TableWriter history_, drops_, events_, timing_;
  std::vector<io::PvdEntry> surface_frames_, volume_frames_;
};

/// Throws InvalidInput when `create` would refuse the path.
void require_usable(const std::filesystem::path& path, bool overwrite);
/// Removes the files of a run; the folder stays, and what else it holds.
void remove_run(const std::filesystem::path& path);
/// Removes a run that has no checkpoint to go on from, so that another can begin in the folder.
void remove_unbegun_run(const std::filesystem::path& path);
/// Whether a folder holds a run: its history or a checkpoint.
[[nodiscard]] bool holds_run(const std::filesystem::path& path);
/// The checkpoint of the latest step in a run's folder. Throws InvalidInput when there is none.
[[nodiscard]] std::filesystem::path newest_checkpoint(const std::filesystem::path& path);

}  // namespace meniscus
