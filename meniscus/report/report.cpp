#include "meniscus/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/history_plots.hpp"
#include "meniscus/report/interface_picture.hpp"
#include "meniscus/report/interface_section.hpp"
#include "meniscus/report/page.hpp"
#include "meniscus/report/page_bundle.hpp"
#include "meniscus/report/page_data.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/summary.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

constexpr int num_page_frames = 8;
constexpr double frame_width = 320.0;  // [px]
// A triangle takes about 65 bytes and half of them face the viewer: 1.2 MB for all pictures of a
// page.
constexpr int most_faces = 36000;

/// Frames small enough for a page, and whether any was coarsened.
struct PageFrames {
  std::vector<SurfaceFrame> frames;
  bool is_coarsened = false;
};

PageFrames page_frames(RunData& run) {
  PageFrames page;
  for (const SurfaceFrame& frame :
       load_surfaces(run, evenly_spaced_frames(run.frames, num_page_frames))) {
    page.frames.push_back(coarse_frame(frame, most_faces / num_page_frames));
    page.is_coarsened |= page.frames.back().mesh.num_faces() < frame.mesh.num_faces();
  }
  return page;
}

std::string interface_html(const PageFrames& page) {
  if (page.frames.empty()) return {};
  const View view = common_view(page.frames, frame_width);
  const ValueRange range = curvature_range(page.frames);
  std::string text = "<h2>The interface</h2>\n<div class=\"card\"><div class=\"frames\">\n";
  for (const SurfaceFrame& frame : page.frames) {
    const std::string time = number_text(frame.t, 3);
    const std::string picture = inline_svg(draw_surface(frame, view, range), view.width,
                                           view.height, "The interface at t = " + time);
    text +=
        fmt::format("<figure>{}<figcaption><i>t</i> = {}</figcaption></figure>\n", picture, time);
  }
  const std::string key =
      inline_svg(draw_key(view, range, have_curvature(page.frames)), PictureKey::width,
                 PictureKey::height, "Scale of colour, length and axes");
  const char* note = page.is_coarsened ? "<figcaption>Drawn with fewer triangles than the run had."
                                         "</figcaption>"
                                       : "";
  return text + fmt::format("</div>\n<div class=\"key\">{}</div>{}</div>\n", key, note);
}

std::string plot_html(const Plot& plot) {
  return "<figure class=\"card\">" +
         inline_svg(draw_plot(plot), plot.width, plot.height, plot.title) + "</figure>\n";
}

/// A plot of the sections of all frames, coloured by time.
Plot section_plot(const std::vector<SurfaceFrame>& frames, const ValueRange& times, int normal) {
  const bool is_flow_plane = normal == 2;
  Plot plot{.title = is_flow_plane ? "Sections in the x–y plane" : "Sections in the x–z plane",
            .x_label = "x [R₀]",
            .y_label = is_flow_plane ? "y [R₀]" : "z [R₀]"};
  plot.has_equal_scales = true;
  plot.height = 400.0;
  for (const SurfaceFrame& frame : frames) {
    Curve curve = section_through_centroids(frame, normal);
    curve.stroke = hex(times.color(frame.t));
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

std::string sections_html(const std::vector<SurfaceFrame>& frames) {
  if (frames.empty()) return {};
  // Leaves out the ends of viridis: dark is faint on a dark page, yellow on a light one.
  const ValueRange times{.low = frames.front().t,
                         .high = std::max(frames.back().t, frames.front().t + 1e-12),
                         .first = 0.25,
                         .last = 0.9};
  std::string text = "<div class=\"plots sections\">\n";
  for (const int normal : {2, 1}) text += plot_html(section_plot(frames, times, normal));
  if (frames.size() == 1) return text + "</div>\n";
  constexpr double width = 560.0, height = 56.0;
  const std::string bar = draw_color_bar(
      times, "Sections through each drop’s centroid, by time t [1/G]", 24.0, 24.0, 420.0);
  return text + "<div class=\"key\">" + inline_svg(bar, width, height, "Colours of time") +
         "</div></div>\n";
}

std::string plots_html(const RunData& run) {
  std::string text;
  for (const PlotGroup& group : history_plots(run)) {
    text += fmt::format("<h2>{}</h2>\n<div class=\"plots\">\n", group.heading);
    for (const Plot& plot : group.plots) {
      text += plot_html(plot);
    }
    text += "</div>\n";
  }
  return text;
}

/// The pictures and plots that are visible without scripts and on paper. The page's script replaces
/// each section by its own view.
std::string still_html(RunData& run) {
  const PageFrames page = page_frames(run);
  return "<section class=\"still view\">\n" + interface_html(page) + sections_html(page.frames) +
         "</section>\n<section class=\"still plots-of-run\">\n" + plots_html(run) + "</section>\n";
}

std::string end_html(const RunData& run) {
  return "<h2>The run</h2>\n<div class=\"columns\">\n" + facts_html(run) + phases_html(run) +
         "</div>\n" + drops_html(run) + case_html(run);
}

std::string title_of(const RunData& run) {
  return run.facts.title.empty() ? "A run of Meniscus" : run.facts.title;
}

std::string page_html(RunData& run) {
  PageParts parts{.title = title_of(run), .content = {}, .data = {}};
  const PageBudget budget;
  if (has_page_bundle()) {
    PageRun packed = page_run(run, budget);
    parts.data = data_elements("report", std::span(&run, 1), std::span(&packed, 1), budget);
  }
  const std::string stills =
      still_html(run);  // before the heading, which lists the faults found here
  parts.content =
      heading_html(run) + tiles_html(run) + "<div id=\"app\"></div>\n" + stills + end_html(run);
  return whole_page(parts);
}

}  // namespace

std::string live_page(const fs::path& run_directory) {
  if (!has_page_bundle()) {
    reject_input(
        "--watch: this program was built without the page's script; install node and npm and build "
        "again");
  }
  const RunData run = load_run(run_directory);
  PageParts parts{.title = title_of(run), .content = {}, .data = {}, .is_live = true};
  parts.data = live_data_element(run);
  parts.content = heading_html(run) + "<div id=\"app\"></div>\n<h2>The run</h2>\n" +
                  facts_html(run) + case_html(run);
  return whole_page(parts);
}

LivePart live_surface(const fs::path& path, double t) {
  // A live page fetches one frame at a time, so frames may be larger than in a page that holds all.
  constexpr int most_live_faces = 60000;
  const SurfaceFrame whole = load_surface(path, t);
  PackedFrame frame = packed_surface(coarse_frame(whole, most_live_faces));
  frame.num_faces_of_run = whole.mesh.num_faces();
  return {entry_json(frame), std::move(frame.bytes)};
}

LivePart live_cuts(const fs::path& path, double t) {
  PackedFrame cuts = packed_cuts(t, load_cuts(path));
  return {entry_json(cuts), std::move(cuts.bytes)};
}

void write_report(const fs::path& run_directory) {
  RunData run = load_run(run_directory);
  io::write_file(run_directory / io::RunFiles::page, page_html(run));
}

}  // namespace meniscus
