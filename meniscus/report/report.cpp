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
// A triangle takes about 45 bytes; half of them face the viewer: 1 MB for all pictures of a page.
constexpr int most_faces = 48000;

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

/// Sections of all frames in one plot, coloured by time.
std::string section_html(const std::vector<SurfaceFrame>& frames) {
  if (frames.empty()) return {};
  Plot plot{.title = "Sections in the plane of flow through each drop’s centroid",
            .x_label = "x [R₀]",
            .y_label = "y [R₀]"};
  plot.has_equal_scales = true;
  plot.width = 760.0;
  plot.height = 420.0;
  const ValueRange times{frames.front().t, std::max(frames.back().t, frames.front().t + 1e-12)};
  for (const SurfaceFrame& frame : frames) {
    Curve curve = section_through_centroids(frame);
    curve.stroke = hex(viridis(0.92 * times.fraction(frame.t)));  // 0.92: yellow is faint on white
    plot.curves.push_back(std::move(curve));
  }
  return "<div class=\"card wide\" style=\"margin-top:16px\"><figure>" +
         inline_svg(draw_plot(plot), plot.width, plot.height, plot.title) + "</figure></div>\n";
}

std::string plots_html(const RunData& run) {
  std::string text;
  for (const PlotGroup& group : history_plots(run)) {
    text += fmt::format("<h2>{}</h2>\n<div class=\"plots\">\n", group.heading);
    for (const Plot& plot : group.plots) {
      text += "<figure class=\"card\">" +
              inline_svg(draw_plot(plot), plot.width, plot.height, plot.title) + "</figure>\n";
    }
    text += "</div>\n";
  }
  return text;
}

std::string page_html(RunData& run) {
  const PageFrames page = page_frames(run);
  const std::string pictures = interface_html(page) + section_html(page.frames);
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
         "beside this page, the meshes in surface.pvd and volume.pvd.</footer>\n"
         "</main>\n</body>\n</html>\n";
}

}  // namespace

void write_report(const fs::path& run_directory) {
  RunData run = load_run(run_directory);
  io::write_file(run_directory / "report.html", page_html(run));
}

}  // namespace meniscus
