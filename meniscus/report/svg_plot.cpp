#include "meniscus/report/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "meniscus/report/curve_path.hpp"
#include "meniscus/report/text.hpp"
#include "meniscus/report/ticks.hpp"

namespace meniscus::report {
namespace {

// [px] Letters are 12 px high and about 6.6 px wide.
constexpr double letter_width = 6.6, title_line = 18.0, legend_line = 38.0, line_sample = 20.0;
constexpr double margin_right = 14.0, margin_bottom = 38.0, margin_side = 14.0;

/// The mapping from data to the picture.
struct PlotArea {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;  ///< [px], y downwards
  Ticks x, y;
  bool is_log = false;

  [[nodiscard]] double to_x(double value) const {
    return left + (value - x.min) / (x.max - x.min) * (right - left);
  }
  [[nodiscard]] double to_y(double value) const {
    const double share = is_log ? std::log(value / y.min) / std::log(y.max / y.min)
                                : (value - y.min) / (y.max - y.min);
    return bottom - share * (bottom - top);
  }
};

/// The smallest and largest value that can be drawn.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool is_empty() const { return low > high; }
};

/// Beyond 10^±300 differences and quotients overflow. No result of a run is that large.
constexpr double largest_drawable = 1e300;

bool is_within(double value) { return std::abs(value) < largest_drawable; }

bool is_drawable(const Curve& curve, std::size_t i, bool is_log) {
  return is_within(curve.x[i]) && is_within(curve.y[i]) &&
         (!is_log || curve.y[i] > 1.0 / largest_drawable);
}

struct Extents {
  Extent x, y;
};

Extents data_extents(const Plot& plot) {
  Extents extents;
  for (const Curve& curve : plot.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      // The x-axis includes gaps of y, so that all plots of a run have the same x-axis.
      if (is_within(curve.x[i])) extents.x.add(curve.x[i]);
      if (is_drawable(curve, i, plot.is_log)) extents.y.add(curve.y[i]);
    }
  }
  if (extents.x.is_empty()) extents.x = {0.0, 1.0};
  if (extents.y.is_empty()) extents.y = {1.0, 10.0};
  if (plot.includes_zero && !plot.is_log) extents.y.add(0.0);
  return extents;
}

/// Widens one range until both axes have the same scale on the picture.
void equalize_scales(Extents& extents, double width, double height) {
  const double slack = 1.08;  // room between the curves and the frame
  const auto middle = [](const Extent& e) { return 0.5 * (e.low + e.high); };
  const double x = middle(extents.x), y = middle(extents.y);
  const double unit = slack * std::max({(extents.x.high - extents.x.low) / width,
                                        (extents.y.high - extents.y.low) / height, 1e-12});
  extents.x = {x - 0.5 * unit * width, x + 0.5 * unit * width};
  extents.y = {y - 0.5 * unit * height, y + 0.5 * unit * height};
}

/// Width of a text [px]; continuation bytes of UTF-8 do not count.
double text_width(std::string_view text) {
  return letter_width * static_cast<double>(
                            std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

bool has_legend(const Plot& plot) {
  return std::ranges::any_of(plot.curves, [](const Curve& c) { return !c.label.empty(); });
}

PlotArea plot_area(const Plot& plot) {
  PlotArea area{.left = margin_side + 44.0,
                .right = plot.width - margin_right,
                .top = has_legend(plot) ? 52.0 : 36.0,
                .bottom = plot.height - margin_bottom,
                .x = {},
                .y = {},
                .is_log = plot.is_log};
  Extents extents = data_extents(plot);
  if (plot.has_equal_scales) {
    equalize_scales(extents, area.right - area.left, area.bottom - area.top);
  }
  const bool is_rounded = !plot.has_equal_scales;
  const auto count = [](double length, double spacing) {
    return std::max(2, static_cast<int>(length / spacing));  // one mark per `spacing` px
  };
  area.y = plot.is_log ? log_ticks(extents.y.low, extents.y.high)
                       : linear_ticks(extents.y.low, extents.y.high,
                                      count(area.bottom - area.top, 45.0), is_rounded);
  double widest = 0.0;
  for (const std::string& label : area.y.labels) widest = std::max(widest, text_width(label));
  const double label_room = plot.y_label.empty() ? 0.0 : 18.0;
  if (!plot.has_equal_scales) area.left = margin_side + widest + 8.0 + label_room;
  area.x = linear_ticks(extents.x.low, extents.x.high, count(area.right - area.left, 75.0), false);
  return area;
}

std::string draw_axes(const Plot& plot, const PlotArea& f) {
  std::string grid, labels;
  for (std::size_t i = 0; i < f.x.values.size(); ++i) {
    const double x = f.to_x(f.x.values[i]);
    grid += fmt::format("M{:.1f} {:.1f}V{:.1f}", x, f.top, f.bottom);
    labels += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", x,
                          f.bottom + 16.0, f.x.labels[i]);
  }
  for (std::size_t i = 0; i < f.y.values.size(); ++i) {
    const double y = f.to_y(f.y.values[i]);
    grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", f.left, y, f.right);
    labels += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)",
                          f.left - 7.0, y + 4.0, f.y.labels[i]);
  }
  if (!f.y.factor.empty()) {
    labels +=
        fmt::format(R"(<text class="small" x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)",
                    f.right, f.top - 6.0, f.y.factor);
  }
  const std::string x_factor = f.x.factor.empty() ? "" : " (" + f.x.factor + ")";
  labels +=
      fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)",
                  0.5 * (f.left + f.right), f.bottom + 33.0, markup_text(plot.x_label) + x_factor);
  if (!plot.y_label.empty()) {
    labels += fmt::format(
        R"x(<text transform="translate({:.1f} {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)x",
        margin_side, 0.5 * (f.top + f.bottom), markup_text(plot.y_label));
  }
  return fmt::format(
      R"(<path class="grid" d="{}"/><path class="ax" d="M{:.1f} {:.1f}V{:.1f}H{:.1f}"/>{})", grid,
      f.left, f.top, f.bottom, f.right, labels);
}

std::string stroke_of(const Curve& curve) {
  const std::string dash = curve.dash == 0 ? "" : fmt::format(" d{}", curve.dash);
  if (!curve.stroke.empty()) {
    return fmt::format(R"(class="ln{}" style="stroke:{}")", dash, curve.stroke);
  }
  return fmt::format(R"(class="ln s{}{}")", curve.color % num_plot_colors, dash);
}

std::string draw_heading(const Plot& plot, const PlotArea& f) {
  const std::string unit = plot.unit.empty() ? ""
                                             : fmt::format(R"( <tspan class="unit">[{}]</tspan>)",
                                                           markup_text(plot.unit));
  std::string text = fmt::format(R"(<text class="ttl" x="{:.1f}" y="{:.1f}">{}{}</text>)",
                                 margin_side, title_line, markup_text(plot.title), unit);
  double x = margin_side;
  for (const Curve& curve : plot.curves) {
    if (curve.label.empty()) continue;
    const double next = x + line_sample + 6.0 + text_width(curve.label) + 14.0;
    if (next > f.right + 14.0) break;  // curves without room in the legend still have a tooltip
    text +=
        fmt::format(R"(<path {} d="M{:.1f} {:.1f}h{:.0f}"/><text x="{:.1f}" y="{:.1f}">{}</text>)",
                    stroke_of(curve), x, legend_line - 4.0, line_sample, x + line_sample + 6.0,
                    legend_line, markup_text(curve.label));
    x = next;
  }
  return text;
}

std::string draw_marks(const Plot& plot, const PlotArea& f) {
  std::string text;
  for (const Mark& mark : plot.marks) {
    if (!(mark.x >= f.x.min && mark.x <= f.x.max)) continue;
    text +=
        fmt::format(R"(<path class="mk" d="M{0:.1f} {1:.1f}V{2:.1f}"><title>{3}</title></path>)",
                    f.to_x(mark.x), f.top, f.bottom, markup_text(mark.label));
  }
  return text;
}

std::string draw_curve(const Plot& plot, const Curve& curve, const PlotArea& f) {
  std::vector<PicturePoint> points;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    points.push_back(is_drawable(curve, i, plot.is_log)
                         ? PicturePoint{f.to_x(curve.x[i]), f.to_y(curve.y[i])}
                         : gap);
  }
  const CurvePath path = curve_path(points);
  std::string text;
  const std::string title =
      curve.label.empty() ? "" : fmt::format("<title>{}</title>", markup_text(curve.label));
  if (!path.line.empty()) {
    text += fmt::format(R"(<path {} d="{}">{}</path>)", stroke_of(curve), path.line, title);
  }
  const std::string fill = curve.stroke.empty()
                               ? fmt::format(R"(class="f{}")", curve.color % num_plot_colors)
                               : fmt::format(R"(fill="{}")", curve.stroke);
  for (const PicturePoint& dot : path.dots) {
    text += fmt::format(R"(<circle {} cx="{:.1f}" cy="{:.1f}" r="3"/>)", fill, dot.x, dot.y);
  }
  return text;
}

}  // namespace

std::string draw_plot(const Plot& plot) {
  const PlotArea area = plot_area(plot);
  std::string content = draw_axes(plot, area) + draw_marks(plot, area);
  for (const Curve& curve : plot.curves) content += draw_curve(plot, curve, area);
  return content + draw_heading(plot, area);
}

std::string inline_svg(std::string_view content, double width, double height,
                       std::string_view label) {
  return fmt::format(R"(<svg viewBox="0 0 {:g} {:g}" role="img" aria-label="{}">{}</svg>)", width,
                     height, markup_text(label), content);
}

std::string svg_file(std::string_view content, double width, double height) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\"><style>{2}</style><rect class=\"bg\" width=\"{0:g}\" height=\"{1:g}\"/>"
      "{3}</svg>\n",
      width, height, plot_style(), content);
}

}  // namespace meniscus::report
