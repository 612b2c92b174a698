#include "meniscus/report/stills.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/history_plots.hpp"
#include "meniscus/report/mesh_cut.hpp"
#include "meniscus/report/page_data.hpp"
#include "meniscus/report/svg_plot.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

constexpr int num_frames = 6, num_columns = 3;
constexpr double frame_width = 320.0, caption_height = 26.0;  // [px]
constexpr double cut_width = 460.0, cut_gap = 20.0;

/// An svg group of the content, translated by (x, y).
std::string translated_group(const std::string& content, double x, double y) {
  return fmt::format(R"x(<g transform="translate({:.1f} {:.1f})">{}</g>)x", x, y, content);
}

std::string caption(double t, double x, double y) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">t = {}</text>)", x, y,
                     number_text(t, 3));
}

/// The frames in rows of three, each with its time below.
std::string draw_frames(const std::vector<SurfaceFrame>& frames, const View& view,
                        const ValueRange& range) {
  std::string content;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double x = frame_width * static_cast<double>(i % num_columns);
    const double y =
        (view.height + caption_height) *
        static_cast<double>(i / num_columns);  // NOLINT(bugprone-integer-division): a row
    content += translated_group(draw_surface(frames[i], view, range), x, y);
    content += caption(frames[i].t, x + 0.5 * frame_width, y + view.height + 12.0);
  }
  return content;
}

/// One cut twice side by side, by liquid and by quality, with a key below.
std::string draw_cut_pair(const MeshCut& cut, double t) {
  const double height = cut_height(cut, cut_width);
  const std::string where =
      fmt::format("t = {}, plane {} = {}", number_text(t, 3), "xyz"[cut.normal],
                  number_text(std::abs(cut.offset) < 1e-9 ? 0.0 : cut.offset, 3));
  return draw_cut(cut, CutColors::liquid, cut_width) +
         translated_group(draw_cut(cut, CutColors::quality, cut_width), cut_width + cut_gap, 0.0) +
         fmt::format(R"(<text x="0" y="{:.1f}">{}</text>)", height + 18.0, where) +
         draw_liquid_key(0.0, height + 42.0) +
         draw_color_bar(quality_range(), "Smallest dihedral angle of the cells [°]",
                        cut_width + cut_gap, height + 22.0, 260.0);
}

}  // namespace

std::string interface_svg(RunData& run, std::span<const double> times) {
  const std::vector<io::PvdEntry> chosen = times.empty()
                                               ? evenly_spaced_frames(run.frames, num_frames)
                                               : nearest_frames(run.frames, times);
  const std::vector<SurfaceFrame> frames = load_surfaces(run, chosen);
  if (frames.empty()) return {};
  const View view = common_view(frames, frame_width);
  const ValueRange range = curvature_range(frames);
  const std::size_t rows = (frames.size() + num_columns - 1) / num_columns;
  const std::size_t columns = std::min<std::size_t>(num_columns, frames.size());
  const double width = std::max(frame_width * static_cast<double>(columns), PictureKey::width);
  const double height = (view.height + caption_height) * static_cast<double>(rows);
  const std::string key = translated_group(draw_key(view, range, have_curvature(frames)),
                                           0.5 * (width - PictureKey::width), height);
  return svg_file(draw_frames(frames, view, range) + key, width, height + PictureKey::height);
}

std::string history_svg(const RunData& run) {
  const std::vector<PlotGroup> groups = history_plots(run);
  if (groups.empty()) return {};
  std::string content;
  double y = 0.0, width = 0.0;
  for (const PlotGroup& group : groups) {
    for (std::size_t i = 0; i < group.plots.size(); ++i) {
      const Plot& plot = group.plots[i];
      const bool is_left = i % 2 == 0;
      content += translated_group(draw_plot(plot), is_left ? 0.0 : plot.width, y);
      width = std::max(width, is_left ? plot.width : 2.0 * plot.width);
      if (!is_left || i + 1 == group.plots.size()) y += plot.height;
    }
  }
  return svg_file(content, width, y);
}

std::string deformation_svg(const RunData& run) {
  const PlotSpec& spec = plot_catalogue().front();
  MENISCUS_ASSERT(spec.quantities.front().column == "D");
  Plot plot = history_plot(spec, run);
  if (plot.curves.empty()) return {};
  plot.width = 640.0;
  plot.height = 400.0;
  return svg_file(draw_plot(plot), plot.width, plot.height);
}

std::string mesh_svg(RunData& run, std::span<const double> times) {
  constexpr double margin = 10.0, key_height = 64.0;
  std::vector<io::PvdEntry> chosen = nearest_frames(run.volume_frames, times);
  if (times.empty() && !run.volume_frames.empty()) chosen = {run.volume_frames.back()};
  std::string content;
  double y = margin;
  for (const io::PvdEntry& entry : chosen) {
    try {
      const MeshCut cut = load_cuts(run.folder / entry.file).front();
      content += translated_group(draw_cut_pair(cut, entry.t), margin, y);
      y += cut_height(cut, cut_width) + key_height;
    } catch (const InvalidInput& error) {
      run.faults.emplace_back(error.what());
    }
  }
  if (content.empty()) return {};
  return svg_file(content, 2.0 * (margin + cut_width) + cut_gap, y);
}

MoviePicture movie_picture(std::span<const SurfaceFrame> frames) {
  constexpr double width = 800.0, least_height = 240.0, most_height = 520.0;
  MoviePicture picture{common_view(frames, width), curvature_range(frames), width, 0.0};
  View& view = picture.view;
  if (view.height > most_height) {
    view.scale *= most_height / view.height;
    view.height = most_height;
  }
  view.height = std::max(view.height, least_height);
  picture.height = 2.0 * std::ceil(0.5 * (view.height + caption_height + PictureKey::height));
  return picture;
}

std::string movie_svg(const SurfaceFrame& frame, const MoviePicture& picture) {
  const auto& [view, range, width, height] = picture;
  const std::string key =
      translated_group(draw_key(view, range, !frame.curvature.empty()),
                       0.5 * (width - PictureKey::width), view.height + caption_height);
  return svg_file(
      draw_surface(frame, view, range) + caption(frame.t, 0.5 * width, view.height + 12.0) + key,
      width, height);
}

}  // namespace meniscus::report
