#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// Writes `report.html` into a run's folder (its files: docs/notation.md). The page shows what ran,
/// pictures of the interface, plots of the history and the time spent. It needs no
/// network; its script draws the pictures. Parts whose files are missing are left out; unreadable
/// files are named. Throws InvalidInput when the folder holds neither run.json nor history.csv,
/// RunFailure when writing fails.
void write_report(const std::filesystem::path& run_directory);

/// The page of a run that still computes, for a server. It asks for tables and frames as they
/// appear (docs/report.md), and begins anew where the server is of another `id`. Throws
/// InvalidInput in a program built without the page's script.
[[nodiscard]] std::string live_page(const std::filesystem::path& run_directory,
                                    std::string_view id);

/// One file of a run for the live page: the facts needed beforehand (JSON) and the packed bytes.
struct LivePart {
  std::string entry, bytes;
};
[[nodiscard]] LivePart live_surface(const std::filesystem::path& path, double t);
[[nodiscard]] LivePart live_cuts(const std::filesystem::path& path, double t);

/// Writes one page about two or more runs: overlaid curves, shapes at equal times, a table of
/// differences. Throws InvalidInput when one folder holds no run.
void write_comparison(std::span<const std::filesystem::path> run_directories,
                      const std::filesystem::path& out);

enum class StillFormat { svg, png };

/// Writes pictures into the run's folder and returns their names: interface, history (all plots),
/// deformation (D(t) with its reference) and mesh. The interface is that of the frames nearest to
/// `times`, or of six. The mesh is the cut through the drops in the volume meshes there, or in the
/// last. Pictures without data are left out. Throws InvalidInput when none is left.
std::vector<std::string> write_stills(const std::filesystem::path& run_directory,
                                      StillFormat format, std::span<const double> times = {});

/// Writes a film of all frames of the interface (.mp4) with the program ffmpeg. Throws InvalidInput
/// without frames or without ffmpeg, RunFailure when ffmpeg fails.
void write_movie(const std::filesystem::path& run_directory, const std::filesystem::path& out);

}  // namespace meniscus
