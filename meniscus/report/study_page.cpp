#include "meniscus/report/study_page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/interface_picture.hpp"
#include "meniscus/report/page.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/surface_frames.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

constexpr double kFrameWidth = 220.0;  // [px]
constexpr std::size_t kMostShapes = 60;
constexpr int kMostFaces = 36000;     // in all pictures together, 65 bytes each
constexpr int kMostFacesEach = 1500;  // a picture of this width shows no more

std::string linked(const std::string& text, const std::string& link) {
  if (link.empty()) return markup_text(text);
  return fmt::format("<a href=\"{}\">{}</a>", markup_text(link), markup_text(text));
}

std::string plots_html(const std::vector<Plot>& plots) {
  if (plots.empty()) return {};
  std::string text = "<h2>Against the axes</h2>\n<div class=\"plots\">\n";
  for (const Plot& plot : plots)
    text += "<figure class=\"card\">" +
            inline_svg(draw_plot(plot), plot.width, plot.height, plot.title) + "</figure>\n";
  return text + "</div>\n";
}

/// A run and its last surface.
struct Shape {
  const StudyPageRun* run;
  SurfaceFrame frame;
};

/// The last surfaces of the runs that are shown, evenly chosen where there are too many.
std::vector<Shape> shapes_of(const std::vector<StudyPageRun>& runs) {
  std::vector<const StudyPageRun*> shown;
  for (const StudyPageRun& run : runs)
    if (run.is_shown) shown.push_back(&run);
  const std::size_t stride =
      std::max<std::size_t>(1, (shown.size() + kMostShapes - 1) / kMostShapes);
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < shown.size(); i += stride) {
    RunData data = load_run(shown[i]->folder);
    if (data.frames.empty()) continue;
    const io::PvdEntry last = data.frames.back();
    for (SurfaceFrame& frame : load_surfaces(data, std::span(&last, 1)))
      shapes.push_back({shown[i], std::move(frame)});
  }
  return shapes;
}

std::string shapes_html(const std::vector<StudyPageRun>& runs) {
  std::vector<Shape> shapes = shapes_of(runs);
  if (shapes.empty()) return {};
  const int most = std::min(kMostFacesEach, kMostFaces / static_cast<int>(shapes.size()));
  std::vector<SurfaceFrame> frames;
  for (Shape& shape : shapes) {
    shape.frame = coarse_frame(shape.frame, most);
    frames.push_back(shape.frame);
  }
  const View view = common_view(frames, kFrameWidth);
  const ValueRange range = curvature_range(frames);
  std::string text = "<h2>Shapes at the end</h2>\n<div class=\"card\"><div class=\"frames\">\n";
  for (const Shape& shape : shapes)
    text += fmt::format("<figure>{}<figcaption>{}<br>{}, <i>t</i> = {}</figcaption></figure>\n",
                        inline_svg(draw_surface(shape.frame, view, range), view.width, view.height,
                                   shape.run->name),
                        linked(shape.run->name, shape.run->link), markup_text(shape.run->outcome),
                        number_text(shape.frame.t, 3));
  return text + "</div></div>\n<div class=\"key\">" +
         inline_svg(draw_key(view, range, have_curvature(frames)), PictureKey::width,
                    PictureKey::height, "Scale of colour, length and axes") +
         "</div>\n";
}

std::string table_html(const StudyPage& page) {
  std::string text = "<h2>The table</h2>\n<div class=\"card scroll\"><table><thead><tr>";
  for (const std::string& column : page.columns) text += "<th>" + markup_text(column) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : page.rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + markup_text(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string runs_html(const std::vector<StudyPageRun>& runs) {
  std::string text =
      "<h2>The runs</h2>\n<div class=\"card scroll\"><table><thead><tr><th>run</th><th>outcome"
      "</th></tr></thead><tbody>\n";
  for (const StudyPageRun& run : runs)
    text += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", linked(run.name, run.link),
                        markup_text(run.outcome));
  return text + "</tbody></table></div>\n";
}

}  // namespace

void write_study_page(const StudyPage& page, const std::filesystem::path& file) {
  const std::string content =
      fmt::format("<header><h1>{}</h1>\n<p class=\"lead\">{}</p>\n</header>\n",
                  markup_text(page.title), markup_text(page.lead)) +
      plots_html(page.plots) + shapes_html(page.runs) + table_html(page) + runs_html(page.runs);
  io::write_file(file, whole_page({.title = page.title, .content = content, .data = {}}));
}

}  // namespace meniscus::report
