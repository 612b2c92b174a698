#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/history_plots.hpp"
#include "meniscus/report/interface_picture.hpp"
#include "meniscus/report/report.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

constexpr int num_frames = 6, num_columns = 3;
constexpr double frame_width = 320.0, caption_height = 26.0;  // [px]

/// A part of a picture moved to (x, y).
std::string placed(const std::string& content, double x, double y) {
  return fmt::format(R"x(<g transform="translate({:.1f} {:.1f})">{}</g>)x", x, y, content);
}

/// Frames in rows of three, each with its time below.
std::string draw_frames(const std::vector<SurfaceFrame>& frames, const View& view,
                        const ValueRange& range) {
  std::string content;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double x = frame_width * static_cast<double>(i % num_columns);
    const double y = (view.height + caption_height) * static_cast<double>(i / num_columns);
    content += placed(draw_surface(frames[i], view, range), x, y);
    content += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">t = {}</text>)",
                           x + 0.5 * frame_width, y + view.height + 12.0, readable(frames[i].t, 3));
  }
  return content;
}

}  // namespace

void write_interface_svg(const fs::path& run_directory, const fs::path& out,
                         std::span<const double> times) {
  RunData run = load_run(run_directory);
  const std::vector<io::PvdEntry> chosen =
      times.empty() ? spread_frames(run.frames, num_frames) : nearest_frames(run.frames, times);
  const std::vector<SurfaceFrame> frames = load_surfaces(run, chosen);
  if (frames.empty()) {
    reject_input("{}: no frame of the surface can be read", run_directory.string());
  }
  const View view = common_view(frames, frame_width);
  const ValueRange range = curvature_range(frames);
  const std::size_t rows = (frames.size() + num_columns - 1) / num_columns;
  const std::size_t columns = std::min<std::size_t>(num_columns, frames.size());
  const double width = std::max(frame_width * static_cast<double>(columns), PictureKey::width);
  const double height = (view.height + caption_height) * static_cast<double>(rows);
  const std::string key = placed(draw_key(view, range, have_curvature(frames)),
                                 0.5 * (width - PictureKey::width), height);
  io::write_file(
      out, svg_file(draw_frames(frames, view, range) + key, width, height + PictureKey::height));
}

void write_history_svg(const fs::path& run_directory, const fs::path& out) {
  const RunData run = load_run(run_directory);
  const std::vector<PlotGroup> groups = history_plots(run);
  if (groups.empty()) reject_input("{}: no history to plot", run_directory.string());
  std::string content;
  double y = 0.0, width = 0.0;
  for (const PlotGroup& group : groups) {
    for (std::size_t i = 0; i < group.plots.size(); ++i) {
      const Plot& plot = group.plots[i];
      const bool is_left = i % 2 == 0;
      content += placed(draw_plot(plot), is_left ? 0.0 : plot.width, y);
      width = std::max(width, is_left ? plot.width : 2.0 * plot.width);
      if (!is_left || i + 1 == group.plots.size()) y += plot.height;
    }
  }
  io::write_file(out, svg_file(content, width, y));
}

}  // namespace meniscus
