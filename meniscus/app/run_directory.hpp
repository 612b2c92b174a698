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

/// The folder of a run (docs/notation.md): its tables, frames, checkpoints and run.json.
class RunDirectory {
 public:
  /// Makes a folder for a new run. Throws InvalidInput when the path cannot be a folder, holds a
  /// run already, or is locked by another program. With `overwrite` the files of that run are
  /// removed first. The folder stays locked as long as this object lives. The tables have columns
  /// of the given physics.
  static RunDirectory create(const std::filesystem::path& path, bool overwrite,
                             RunPhysics physics = {});
  /// Resumes a run from the state at `first_step`, time t. Rows and frames from there on are
  /// removed, to be written again. Throws InvalidInput when another program has locked the folder,
  /// or its tables have other columns.
  static RunDirectory take_up(const std::filesystem::path& path, std::int64_t first_step, double t,
                              RunPhysics physics = {});

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The frames that surface.pvd and volume.pvd name.
  [[nodiscard]] const std::vector<io::PvdEntry>& surface_frames() const { return surface_frames_; }
  [[nodiscard]] const std::vector<io::PvdEntry>& volume_frames() const { return volume_frames_; }

  void add_rows(const HistoryRow& history, const std::vector<DropRow>& drops);
  void add_events(const HistoryRow& history, const std::vector<TopologyEvent>& events);
  void add_timing(std::int64_t step, double t, const PhaseSeconds& seconds);
  void add_surface_frame(const Evolution& evolution);
  /// The file that the state's frame of the volume is to be written to, in a folder that is there.
  [[nodiscard]] std::filesystem::path begin_volume_frame(const Evolution& evolution);
  /// Lists that frame, once it is written.
  void list_volume_frame(const Evolution& evolution);
  /// Writes checkpoint-<step>.h5. Keeps the last two checkpoints and those around events (the steps
  /// in events.csv and the steps before them); removes all others.
  void write_checkpoint(const Archive& archive, std::int64_t step);
  void write_text(const std::string& name, const std::string& text) const;

 private:
  RunDirectory(FolderLock lock, std::filesystem::path path, RunPhysics physics,
               std::optional<std::int64_t> first_step);

  FolderLock lock_;
  std::filesystem::path path_;
  RunPhysics physics_;
  std::set<std::int64_t> kept_steps_;  // steps whose checkpoints are kept because of events
  io::TableWriter history_, drops_, events_, timing_;
  std::vector<io::PvdEntry> surface_frames_, volume_frames_;
};

/// Throws InvalidInput when `create` would refuse the path.
void require_usable(const std::filesystem::path& path, bool overwrite);
/// Removes the files of a run. The folder and its other files stay.
void remove_run(const std::filesystem::path& path);
/// Removes a run without checkpoint, which could not be resumed, so that another can begin in the
/// folder.
void remove_unbegun_run(const std::filesystem::path& path);
/// Whether a folder holds a run: its history or a checkpoint.
[[nodiscard]] bool holds_run(const std::filesystem::path& path);
/// The checkpoint of the latest step in a run's folder. Throws InvalidInput when there is none.
[[nodiscard]] std::filesystem::path newest_checkpoint(const std::filesystem::path& path);

}  // namespace meniscus
