#include "meniscus/report/colormap.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace meniscus::report {
namespace {

/// Relative luminance of an sRGB colour (WCAG 2).
double luminance(const Color& color) {
  const auto linear = [](double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

TEST(Colormap, EndsAndBeyond) {
  EXPECT_EQ(hex(viridis(0.0)), "#440154");
  EXPECT_EQ(hex(viridis(1.0)), "#fde725");
  EXPECT_EQ(hex(viridis(-3.0)), "#440154");
  EXPECT_EQ(hex(viridis(7.0)), "#fde725");
  EXPECT_EQ(hex(viridis(std::numeric_limits<double>::quiet_NaN())), "#440154");
}

TEST(Colormap, GrowsLighter) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_LT(luminance(viridis(0.01 * i)), luminance(viridis(0.01 * (i + 1)))) << i;
  }
}

TEST(Colormap, ShadesStayColours) {
  EXPECT_EQ(hex(shade({0.5, 1.0, 0.0}, 2.0)), "#ffff00");
  EXPECT_EQ(hex(shade({0.5, 1.0, 0.0}, 0.0)), "#000000");
  EXPECT_EQ(hex(tint({0.0, 0.5, 1.0}, 1.0)), "#ffffff");
}

TEST(Colormap, RangeForgetsWildValues) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(0.001 * i);
  values.push_back(1e9);
  values.push_back(std::numeric_limits<double>::infinity());
  const ValueRange range = color_range(values);
  EXPECT_NEAR(range.low, 0.01, 1e-3);
  EXPECT_NEAR(range.high, 0.99, 1e-3);
}

TEST(Colormap, RangeOfOneValueHasExtent) {
  const ValueRange range = color_range(std::vector<double>(10, 2.0));
  EXPECT_LT(range.low, 2.0);
  EXPECT_GT(range.high, 2.0);
  EXPECT_NEAR(range.fraction(2.0), 0.5, 1e-12);
  const ValueRange zero = color_range(std::vector<double>(10, 0.0));
  EXPECT_LT(zero.low, zero.high);
  EXPECT_LT(color_range({}).low, color_range({}).high);
}

}  // namespace
}  // namespace meniscus::report
