#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "meniscus/report/colormap.hpp"
#include "meniscus/report/mesh_cut.hpp"

namespace meniscus::report {
namespace {

constexpr double subpixel = 0.1;  // [px] points are written as whole multiples of this length
// Colours of the matrix, then of the drops in turn. They are pale so that cell edges show.
constexpr std::array<const char*, 7> liquid_colors = {"#eef1f5", "#8fc1e3", "#f3b58a", "#8fd6bb",
                                                      "#dfb3cd", "#ecd08a", "#b9c4d0"};

std::string fill_of(const CutPolygon& polygon, CutColors colors) {
  if (colors == CutColors::quality) return hex(quality_range().color(polygon.min_dihedral_deg));
  const int count = static_cast<int>(liquid_colors.size());
  const int index = polygon.region <= 0 ? 0 : 1 + (polygon.region - 1) % (count - 1);
  return liquid_colors[static_cast<std::size_t>(index)];
}

}  // namespace

ValueRange quality_range() { return {0.0, 60.0}; }

double cut_height(const MeshCut& cut, double width) {
  const double breadth = std::max(cut.high[0] - cut.low[0], 1e-12);
  return std::ceil(width * (cut.high[1] - cut.low[1]) / breadth);
}

std::string draw_cut(const MeshCut& cut, CutColors colors, double width) {
  const double scale = width / std::max(cut.high[0] - cut.low[0], 1e-12);
  const double height = cut_height(cut, width);
  const auto at = [&](const std::array<double, 2>& x) {
    return fmt::format("{} {}", std::lround(scale * (x[0] - cut.low[0]) / subpixel),
                       std::lround(scale * (cut.high[1] - x[1]) / subpixel));
  };
  // A nested svg element clips what reaches beyond the window.
  std::string text =
      fmt::format(R"(<svg width="{0:g}" height="{1:g}" viewBox="0 0 {2:g} {3:g}">)"
                  R"(<g class="cut" stroke="{4}" stroke-width="{5}">)",
                  width, height, width / subpixel, height / subpixel,
                  colors == CutColors::liquid ? "#5c6671" : "#ffffff", 0.5 / subpixel);
  for (const CutPolygon& polygon : cut.polygons) {
    text += fmt::format(R"(<path fill="{}" d="M)", fill_of(polygon, colors));
    for (int k = 0; k < polygon.num_points; ++k) {
      if (k > 0) text += 'L';
      text += at(cut.points[polygon.first_point + static_cast<std::size_t>(k)]);
    }
    text += "z\"/>";
  }
  return text + "</g></svg>";
}

std::string draw_liquid_key(double x, double y) {
  std::string text;
  for (const auto& [color, label] : {std::pair(0, "matrix"), std::pair(1, "drop")}) {
    text += fmt::format(
        R"(<rect class="ax" x="{0:.1f}" y="{1:.1f}" width="12" height="12" style="fill:{2}"/>)"
        R"(<text x="{3:.1f}" y="{4:.1f}">{5}</text>)",
        x, y - 10.0, liquid_colors[static_cast<std::size_t>(color)], x + 18.0, y, label);
    x += 80.0;
  }
  return text;
}

}  // namespace meniscus::report
