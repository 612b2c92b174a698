#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// Makes `report.html` in a run's folder (its files are in docs/notation.md): one page without
/// outside references that needs neither network nor scripts, with what ran, pictures of the
/// interface, plots of the history and the time spent. Files that are missing leave their part of
/// the page out; what cannot be read is named on it. Throws InvalidInput when the folder holds
/// neither run.json nor history.csv, RunFailure when the disk refuses.
void write_report(const std::filesystem::path& run_directory);

/// The page of a run that is still going on, for a server: it asks for the tables and frames as
/// they come (docs/report.md). Throws InvalidInput in a program built without the page's script.
[[nodiscard]] std::string live_page(const std::filesystem::path& run_directory);

/// One file of a run for that page: what it must know beforehand (JSON), and the packed bytes.
struct LivePart {
  std::string entry, bytes;
};
[[nodiscard]] LivePart live_surface(const std::filesystem::path& path, double t);
[[nodiscard]] LivePart live_cuts(const std::filesystem::path& path, double t);

/// One page of two or more runs: curves over each other, shapes at equal times, a table of what
/// differs. Throws InvalidInput when one is no folder of a run.
void write_comparison(std::span<const std::filesystem::path> run_directories,
                      const std::filesystem::path& out);

enum class StillFormat { svg, png };

/// Pictures that stand alone, in the run's folder: interface (at the frames nearest to `times`, or
/// at six when none are given), history (all plots), deformation (D(t) alone, with its reference)
/// and mesh (the cut through the drops at the last volume mesh, or at those nearest to `times`),
/// each as far as the run has what it shows. Returns their names. Throws InvalidInput when there is
/// nothing to show.
std::vector<std::string> write_stills(const std::filesystem::path& run_directory,
                                      StillFormat format, std::span<const double> times = {});

/// A film of the interface, all frames (.mp4), made by the program ffmpeg. Throws InvalidInput
/// without frames or without ffmpeg, RunFailure when it fails.
void write_movie(const std::filesystem::path& run_directory, const std::filesystem::path& out);

}  // namespace meniscus
