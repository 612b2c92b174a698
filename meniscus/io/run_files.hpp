#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meniscus::io {

/// A table of a run's folder: its name on the page, and its file.
struct RunTableFile {
  const char *name, *file;
};

/// The files of a run's folder, by their names there (docs/notation.md).
struct RunFiles {
  static constexpr const char *history = "history.csv", *drops = "drops.csv",
                              *events = "events.csv", *timing = "timing.csv",
                              *reference = "reference.csv";  ///< what the case is compared with
  static constexpr const char *record = "run.json", *page = "report.html",
                              *crate = "ro-crate-metadata.json";  ///< describes the others
  static constexpr const char *surface_frames = "surface.pvd", *volume_frames = "volume.pvd";
  static constexpr const char *surface_folder = "surface", *volume_folder = "volume";

  static constexpr std::array<RunTableFile, 5> tables{{{"history", history},
                                                       {"drops", drops},
                                                       {"events", events},
                                                       {"timing", timing},
                                                       {"reference", reference}}};
  /// What a run writes, checkpoints apart.
  static constexpr std::array written{history,       drops,          events,       timing,
                                      record,        page,           crate,        surface_frames,
                                      volume_frames, surface_folder, volume_folder};
  /// What a run that goes on in another folder takes along.
  static constexpr std::array taken_along{
      history,        drops,         events,         timing,        record,
      surface_frames, volume_frames, surface_folder, volume_folder, reference};
};

/// The name of a checkpoint, checkpoint-<step>.h5.
[[nodiscard]] std::string checkpoint_name(std::int64_t step);
/// The checkpoints in a folder in rising order of step; none where there is no such folder.
[[nodiscard]] std::vector<std::pair<std::int64_t, std::filesystem::path>> checkpoints(
    const std::filesystem::path& folder);

}  // namespace meniscus::io
