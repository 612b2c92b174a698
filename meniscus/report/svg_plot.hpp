#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meniscus::report {

/// One line of a plot. It has a gap where x or y is not finite (or not positive on a logarithmic
/// axis). A value between two gaps is a dot.
struct Curve {
  std::string label = {};  ///< text in the legend; empty: not in the legend
  std::vector<double> x = {}, y = {};
  int color = 0;            ///< index in the palette of `plot_style`
  int dash = 0;             ///< 0 solid, 1 dashed, 2 dotted
  std::string stroke = {};  ///< a colour of its own instead, "#rrggbb"
};

/// A moment marked across a plot: an event on the axis of time.
struct Mark {
  double x = 0.0;
  std::string label;
};

struct Plot {
  std::string title = {};    ///< the quantity
  std::string unit = {};     ///< of y, shown beside the title; empty: none
  std::string x_label = {};  ///< label of the x-axis with its unit
  std::string y_label = {};  ///< label of the y-axis, where the title is not enough
  std::vector<Curve> curves = {};
  std::vector<Mark> marks = {};
  bool is_log = false;            ///< of y; only where a value is positive
  bool includes_zero = false;     ///< of y
  bool has_equal_scales = false;  ///< x and y have the same scale on the picture
  double width = 560.0, height = 300.0;
};

/// The plot as the content of an `svg` element of its size, drawn with the classes of `plot_style`:
/// frame, ticks, grid, legend, lines.
[[nodiscard]] std::string draw_plot(const Plot& plot);

/// `content` as an `svg` element for a page; screen readers read `label`.
[[nodiscard]] std::string inline_svg(std::string_view content, double width, double height,
                                     std::string_view label);
/// `content` as a complete .svg file that includes the style sheet.
[[nodiscard]] std::string svg_file(std::string_view content, double width, double height);

/// The style sheet of all pictures, light and dark. Lines have the colours of Okabe and Ito, which
/// readers with any colour vision can tell apart; they are lighter on dark pages.
[[nodiscard]] std::string_view plot_style();
inline constexpr int num_plot_colors = 6;

}  // namespace meniscus::report
