#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meniscus::report {

/// One line of a plot; where x or y is not finite (or not positive on a logarithmic axis) it has a
/// gap, and a value between two gaps is a dot.
struct Curve {
  std::string label = {};  ///< in the legend; empty: not there
  std::vector<double> x = {}, y = {};
  int color = 0;            ///< number in the palette of `plot_style`
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
  std::string x_label = {};  ///< with its unit
  std::string y_label = {};  ///< beside the axis, where the title does not say enough
  std::vector<Curve> curves = {};
  std::vector<Mark> marks = {};
  bool is_log = false;            ///< of y; only where a value is positive
  bool includes_zero = false;     ///< of y
  bool has_equal_scales = false;  ///< x and y in the same length on the picture
  double width = 560.0, height = 300.0;
};

/// The picture as the inside of an `svg` element of its size, drawn with the classes of
/// `plot_style`: frame, marks of the axes, grid, legend, lines.
[[nodiscard]] std::string draw_plot(const Plot& plot);

/// `content` as an `svg` element for a page; `label` is read to those who cannot see it.
[[nodiscard]] std::string inline_svg(std::string_view content, double width, double height,
                                     std::string_view label);
/// `content` as a file that stands alone, with the style sheet in it.
[[nodiscard]] std::string svg_file(std::string_view content, double width, double height);

/// The style sheet of all pictures, light and dark. Lines in the colours of Okabe and Ito, told
/// apart with every kind of colour vision; lighter in the dark.
[[nodiscard]] std::string_view plot_style();
inline constexpr int num_plot_colors = 6;

}  // namespace meniscus::report
