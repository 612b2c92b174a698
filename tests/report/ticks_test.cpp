#include "meniscus/report/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace meniscus::report {
namespace {

using Labels = std::vector<std::string>;

TEST(Ticks, RoundNumbersAroundTheData) {
  const Ticks ticks = linear_ticks(0.0, 0.37, 5);
  EXPECT_EQ(ticks.labels, (Labels{"0.0", "0.1", "0.2", "0.3", "0.4"}));
  EXPECT_EQ(ticks.min, 0.0);
  EXPECT_NEAR(ticks.max, 0.4, 1e-15);
  EXPECT_EQ(linear_ticks(-1.0, 1.0, 4).labels, (Labels{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
}

TEST(Ticks, RangeOfTheDataWhenAsked) {
  const Ticks ticks = linear_ticks(0.3, 5.7, 6, false);
  EXPECT_EQ(ticks.min, 0.3);
  EXPECT_EQ(ticks.max, 5.7);
  EXPECT_EQ(ticks.labels, (Labels{"1", "2", "3", "4", "5"}));
}

TEST(Ticks, ShareAFactorWhenSmallOrLarge) {
  const Ticks small = linear_ticks(0.0, 4e-13, 4);
  EXPECT_EQ(small.factor, "×10⁻¹³");
  EXPECT_EQ(small.labels, (Labels{"0", "1", "2", "3", "4"}));
  EXPECT_EQ(linear_ticks(0.0, 3e5, 3).factor, "×10⁵");
  EXPECT_EQ(linear_ticks(0.0, 3e4, 3).factor, "");
}

TEST(Ticks, RangeWithoutExtentIsWidened) {
  const Ticks ticks = linear_ticks(5.0, 5.0, 4);
  EXPECT_LT(ticks.min, 5.0);
  EXPECT_GT(ticks.max, 5.0);
  const Ticks zero = linear_ticks(0.0, 0.0, 4);
  EXPECT_LT(zero.min, 0.0);
  EXPECT_GT(zero.max, 0.0);
  const Ticks nearly = linear_ticks(1.0, 1.0 + 1e-15, 4);
  EXPECT_GT(nearly.max - nearly.min, 0.1);
}

TEST(Ticks, CoverAnyRangeWithAFewDistinctLabels) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0), exponent(-20.0, 20.0);
  for (int i = 0; i < 2000; ++i) {
    const double scale = std::pow(10.0, exponent(random));
    double low = mantissa(random) * scale, high = mantissa(random) * scale;
    if (low > high) std::swap(low, high);
    const Ticks ticks = linear_ticks(low, high, 5);
    const double slack = 2e-3 * (ticks.max - ticks.min);
    ASSERT_LE(ticks.min, low + slack) << low << " " << high;
    ASSERT_GE(ticks.max, high - slack) << low << " " << high;
    ASSERT_GE(ticks.values.size(), 2U);
    ASSERT_LE(ticks.values.size(), 12U);
    const std::set<std::string> distinct(ticks.labels.begin(), ticks.labels.end());
    ASSERT_EQ(distinct.size(), ticks.labels.size()) << low << " " << high;
  }
}

TEST(Ticks, PowersOfTen) {
  EXPECT_EQ(log_ticks(150.0, 38000.0).labels, (Labels{"10²", "10³", "10⁴", "10⁵"}));
  EXPECT_EQ(log_ticks(0.3, 0.9).labels, (Labels{"0.2", "0.5", "1"}));
  EXPECT_EQ(log_ticks(1.0, 100.0).labels, (Labels{"1", "2", "5", "10", "20", "50", "100"}));
  const Ticks wide = log_ticks(1e-20, 1e20);
  EXPECT_LE(wide.values.size(), 8U);
  EXPECT_LE(wide.min, 1e-20 * 1.001);
  EXPECT_GE(wide.max, 1e20 * 0.999);
}

TEST(Ticks, LogarithmicRangeIsNeverAPoint) {
  for (const double value : {1.0, 3.0, 0.02, 1e-7}) {
    const Ticks ticks = log_ticks(value, value);
    EXPECT_LE(ticks.min, value * 1.0001);
    EXPECT_GE(ticks.max, value * 0.9999);
    EXPECT_GT(ticks.max, ticks.min) << value;
  }
}

}  // namespace
}  // namespace meniscus::report
