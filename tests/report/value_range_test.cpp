#include "meniscus/report/value_range.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace meniscus::report {
namespace {

TEST(ValueRange, RangeForgetsWildValues) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(0.001 * i);
  values.push_back(1e9);
  values.push_back(std::numeric_limits<double>::infinity());
  const ValueRange range = color_range(values);
  EXPECT_NEAR(range.low, 0.01, 1e-3);
  EXPECT_NEAR(range.high, 0.99, 1e-3);
}

TEST(ValueRange, RangeOfOneValueHasExtent) {
  const ValueRange range = color_range(std::vector<double>(10, 2.0));
  EXPECT_LT(range.low, 2.0);
  EXPECT_GT(range.high, 2.0);
  EXPECT_NEAR(0.5 * (range.low + range.high), 2.0, 1e-12);
  const ValueRange zero = color_range(std::vector<double>(10, 0.0));
  EXPECT_LT(zero.low, zero.high);
  EXPECT_LT(color_range({}).low, color_range({}).high);
}

}  // namespace
}  // namespace meniscus::report
