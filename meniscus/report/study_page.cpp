#include "meniscus/report/study_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/page.hpp"
#include "meniscus/report/page_data.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/surface_frames.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostShapes = 60;
constexpr int kMostFaces = 36000;     // in all pictures together, 65 bytes each
constexpr int kMostFacesEach = 1500;  // a picture of this width shows no more

std::string linked(const std::string& text, const std::string& link) {
  if (link.empty()) return markup_text(text);
  return fmt::format("<a href=\"{}\">{}</a>", markup_text(link), markup_text(text));
}

Json in_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? Json(value) : Json());
  return list;
}

/// The plots as plot.js draws them; null where a value is not finite.
Json in_json(const std::vector<Plot>& plots) {
  Json list = Json::array();
  for (const Plot& plot : plots) {
    Json curves = Json::array();
    for (const Curve& curve : plot.curves)
      curves.push_back({{"name", curve.label},
                        {"legend", curve.label},
                        {"x", in_json(curve.x)},
                        {"y", in_json(curve.y)},
                        {"color", curve.color},
                        {"dash", curve.dash}});
    list.push_back({{"title", plot.title},
                    {"unit", plot.unit},
                    {"xLabel", plot.x_label},
                    {"isLog", plot.is_log},
                    {"curves", curves}});
  }
  return list;
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

DrawingData data_of(const StudyPage& page) {
  const std::vector<Shape> shapes = shapes_of(page.runs);
  const int most =
      std::min(kMostFacesEach, kMostFaces / std::max(1, static_cast<int>(shapes.size())));
  Json names = Json::array();
  std::vector<PackedFrame> frames;
  for (const Shape& shape : shapes) {
    frames.push_back(packed_surface(coarse_frame(shape.frame, most)));
    names.push_back(
        {{"name", shape.run->name}, {"link", shape.run->link}, {"outcome", shape.run->outcome}});
  }
  return study_drawing_data(in_json(page.plots).dump(), names.dump(), frames);
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
      "<div id=\"app\"></div>\n" + table_html(page) + runs_html(page.runs);
  io::write_file(file, whole_page({.title = page.title,
                                   .content = content,
                                   .data = data_elements(data_of(page)),
                                   .units = PageUnits::both}));
}

}  // namespace meniscus::report
