#include "meniscus/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/history_plots.hpp"
#include "meniscus/report/interface_picture.hpp"
#include "meniscus/report/interface_section.hpp"
#include "meniscus/report/page_style.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/summary.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

constexpr int num_page_frames = 8;
constexpr double frame_width = 320.0;  // [px]
// A triangle takes about 65 bytes; half of them face the viewer: 1.2 MB for all pictures of a page.
constexpr int most_faces = 36000;

/// Frames fit for a page, and whether any had to be made coarser for it.
struct PageFrames {
  std::vector<SurfaceFrame> frames;
  bool is_coarsened = false;
};

PageFrames page_frames(RunData& run) {
  PageFrames page;
  for (const SurfaceFrame& frame : load_surfaces(run, spread_frames(run.frames, num_page_frames))) {
    page.frames.push_back(coarsened(frame, most_faces / num_page_frames));
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
    const std::string time = readable(frame.t, 3);
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

/// Sections of all frames in one plot, coloured by time.
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
  // Without the ends of the colours: the dark one is faint at night, the yellow one by day.
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

std::string page_html(RunData& run) {
  const PageFrames page = page_frames(run);
  const std::string pictures = interface_html(page) + sections_html(page.frames);
  const std::string title = run.facts.title.empty() ? "A run of Meniscus" : run.facts.title;
  // The policy lets a browser load nothing, so that the page is the same wherever it lies.
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
             "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
             "style-src 'unsafe-inline'\"/>\n<title>{}</title>\n<style>{}{}</style>\n</head>\n"
             "<body>\n<main>\n",
             escaped(title), page_style(), plot_style()) +
         heading_html(run) + tiles_html(run) + pictures + plots_html(run) +
         "<h2>The run</h2>\n<div class=\"columns\">\n" + facts_html(run) + phases_html(run) +
         "</div>\n" + drops_html(run) + case_html(run) +
         "<footer>Lengths in R₀, times in 1/G, stresses in μG; G is the rate of strain or shear, "
         "μ the outer viscosity. The figures behind the plots are in history.csv and drops.csv "
         "beside this page, the meshes in the .pvd files.</footer>\n"
         "</main>\n</body>\n</html>\n";
}

}  // namespace

void write_report(const fs::path& run_directory) {
  RunData run = load_run(run_directory);
  io::write_file(run_directory / "report.html", page_html(run));
}

}  // namespace meniscus
