#include "meniscus/report/svg_plot.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "meniscus/report/curve_path.hpp"
#include "tests/report/xml_check.hpp"

namespace meniscus::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

test::Xml drawn(const Plot& plot) {
  return test::parse_xml(inline_svg(draw_plot(plot), plot.width, plot.height, plot.title));
}

long count(const std::string& text, const std::string& part) {
  long n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(CurvePath, GapsAndLonePoints) {
  const CurvePath path = curve_path(
      std::vector<PicturePoint>{{0, 0}, {1, 2}, gap, gap, {3, 3}, gap, {4, 4}, {5, 5.25}});
  EXPECT_EQ(path.line, "M0.0 0.0L1.0 2.0M4.0 4.0L5.0 5.2");
  ASSERT_EQ(path.dots.size(), 1U);
  EXPECT_EQ(path.dots[0].x, 3.0);
  EXPECT_TRUE(curve_path({}).line.empty());
}

TEST(CurvePath, ThinningKeepsSpikesAndEnds) {
  std::vector<PicturePoint> points;
  for (int i = 0; i < 50000; ++i) points.push_back({0.01 * i, i == 31234 ? 99.0 : 0.5});
  const std::string line = curve_path(points).line;
  EXPECT_LT(line.size(), 20000U);
  EXPECT_NE(line.find("L312.3 99.0"), std::string::npos);
  EXPECT_TRUE(line.starts_with("M0.0 0.5"));
  EXPECT_TRUE(line.ends_with("L500.0 0.5"));
}

TEST(SvgPlot, IsWellFormedWhateverTheData) {
  const std::vector<std::vector<double>> series = {{},
                                                   {1.0},
                                                   {nan},
                                                   {0.0, 0.0},
                                                   {nan, 1.0, nan},
                                                   {-1.0, 1e300},
                                                   {1e-300, 2.0},
                                                   {infinity, 1},
                                                   {5.0, nan, infinity},
                                                   {-1e-320, 1e-320}};
  for (const std::vector<double>& y : series) {
    for (const bool is_log : {false, true}) {
      for (const bool has_equal_scales : {false, true}) {
        Plot plot{.title = "A & <B>", .unit = "\"", .x_label = "<x>"};
        std::vector<double> x(y.size());
        std::iota(x.begin(), x.end(), 0.0);
        plot.curves = {{.label = "a<b", .x = x, .y = y}};
        plot.marks = {{0.0, "<event>"}, {nan, ""}};
        plot.is_log = is_log;
        plot.has_equal_scales = has_equal_scales;
        const test::Xml xml = drawn(plot);
        EXPECT_EQ(xml.fault, "");
        EXPECT_EQ(test::bad_coordinate(xml), "") << is_log << has_equal_scales << y.size();
      }
    }
  }
}

TEST(SvgPlot, LineJoinsTheCornersOfItsFrame) {
  Plot plot{.title = "t", .x_label = "x"};
  plot.curves = {{.x = {0.0, 10.0}, .y = {0.0, 1.0}}};
  const std::string svg = draw_plot(plot);
  // The frame is drawn as M left top V bottom H right; the line goes from the one corner to the
  // other because 0 and 1 are marks of the axis.
  double left = 0, top = 0, bottom = 0, right = 0, x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  const std::size_t frame = svg.find("class=\"ax\" d=\""), line = svg.find("class=\"ln s0\" d=\"");
  ASSERT_EQ(std::sscanf(svg.c_str() + frame, "class=\"ax\" d=\"M%lf %lfV%lfH%lf", &left, &top,
                        &bottom, &right),
            4);
  ASSERT_EQ(
      std::sscanf(svg.c_str() + line, "class=\"ln s0\" d=\"M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1),
      4);
  EXPECT_EQ(x0, left);
  EXPECT_EQ(y0, bottom);
  EXPECT_EQ(x1, right);
  EXPECT_EQ(y1, top);
}

TEST(SvgPlot, EqualScalesKeepCirclesRound) {
  Plot plot{.title = "t", .x_label = "x"};
  plot.has_equal_scales = true;
  Curve& curve = plot.curves.emplace_back();
  for (int i = 0; i <= 360; ++i) {
    curve.x.push_back(3.0 + std::cos(M_PI * i / 180.0));
    curve.y.push_back(std::sin(M_PI * i / 180.0));
  }
  const std::string svg = draw_plot(plot);
  const std::size_t start = svg.find("class=\"ln s0\" d=\"") + 17;
  double x = 0, y = 0, x_low = 1e9, x_high = 0, y_low = 1e9, y_high = 0;
  for (std::size_t at = start; svg[at] != '"'; at = svg.find_first_of("L\"", at + 1)) {
    ASSERT_EQ(std::sscanf(svg.c_str() + at + 1, "%lf %lf", &x, &y), 2);
    x_low = std::min(x_low, x), x_high = std::max(x_high, x);
    y_low = std::min(y_low, y), y_high = std::max(y_high, y);
  }
  EXPECT_NEAR(x_high - x_low, y_high - y_low, 0.2);  // coordinates have one decimal
  EXPECT_GT(y_high - y_low, 100.0);
}

TEST(SvgPlot, LegendNamesCurvesAndEndsAtTheFrame) {
  Plot plot{.title = "t", .x_label = "x"};
  for (int i = 0; i < 40; ++i) {
    plot.curves.push_back({.label = "curve", .x = {0, 1}, .y = {0, 1.0 * i}, .color = i});
  }
  const std::string svg = draw_plot(plot);
  EXPECT_EQ(count(svg, "<title>curve</title>"), 40);
  EXPECT_GT(count(svg, ">curve</text>"), 3);
  EXPECT_LT(count(svg, ">curve</text>"), 10);
}

TEST(SvgPlot, FileStandsAlone) {
  const test::Xml xml = test::parse_xml(svg_file("<path d=\"M0 0\"/>", 10, 20));
  EXPECT_EQ(xml.fault, "");
  EXPECT_EQ(test::outside_reference(xml), "");
  EXPECT_EQ(xml.elements, (std::vector<std::string>{"svg", "style", "rect", "path"}));
}

TEST(XmlCheck, FindsFaults) {
  for (const char* text : {"<a>", "</a>", "<a></b>", "<a b=c/>", "<a b=\"&\"/>",
                           "<a b=\"1\" b=\"2\"/>", "a & b", "<a", "<>", "\x01"}) {
    EXPECT_NE(test::parse_xml(text).fault, "") << text;
  }
  EXPECT_EQ(test::parse_xml("<?xml?><a b=\"1 &lt; 2\">x &amp; y<br/></a>").fault, "");
  EXPECT_NE(test::bad_coordinate(test::parse_xml("<a d=\"Mnan 0\"/>")), "");
  EXPECT_NE(test::outside_reference(test::parse_xml("<img src=\"x\"/>")), "");
}

}  // namespace
}  // namespace meniscus::report
