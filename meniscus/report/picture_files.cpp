#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/drawer.hpp"
#include "meniscus/report/rasterize.hpp"
#include "meniscus/report/report.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

/// The frames nearest to `times`, or six between the first and the last when none are given.
std::vector<io::PvdEntry> chosen_frames(const RunData& run, std::span<const double> times) {
  constexpr int num_frames = 6;
  return times.empty() ? evenly_spaced_frames(run.frames, num_frames)
                       : nearest_frames(run.frames, times);
}

/// The volume meshes nearest to `times`, or the last one when none are given.
std::vector<io::PvdEntry> chosen_meshes(const RunData& run, std::span<const double> times) {
  if (times.empty() && !run.volume_frames.empty()) return {run.volume_frames.back()};
  return nearest_frames(run.volume_frames, times);
}

/// Throws InvalidInput for a time before the first frame or after the last.
void require_within_run(const RunData& run, std::span<const double> times) {
  if (run.frames.empty()) return;
  const double first = run.frames.front().t, last = run.frames.back().t;
  for (const double t : times)
    if (!(t >= first && t <= last))
      reject_input("--times {}: the run has frames from t = {:.6g} to {:.6g}", t, first, last);
}

}  // namespace

std::vector<std::string> write_stills(const fs::path& run_directory, StillFormat format,
                                      std::span<const double> times) {
  constexpr double png_scale = 2.0;  // at least 300 dots per inch in a journal column of 85 mm
  const bool is_png = format == StillFormat::png;
  RunData run = load_run(run_directory);
  require_within_run(run, times);
  PageRun page = picture_run(run, chosen_frames(run, times), chosen_meshes(run, times));
  const DrawingData data =
      drawing_data("report", std::span(&run, 1), std::span(&page, 1), whole_tables);
  Drawer drawer(is_png ? "--png" : "--svg", data, {"interface", "deformation", "mesh", "history"});
  std::vector<std::string> names;
  while (const auto picture = drawer.next()) {
    names.push_back(picture->name + (is_png ? ".png" : ".svg"));
    io::write_file(run_directory / names.back(),
                   is_png ? png_of(picture->svg, png_scale) : picture->svg);
  }
  if (names.empty()) {
    reject_input("{}: no frame, mesh or history that a picture could show{}",
                 run_directory.string(), run.faults.empty() ? "" : "; " + run.faults.front());
  }
  return names;
}

}  // namespace meniscus
