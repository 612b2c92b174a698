#include "meniscus/app/progress.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

std::string shown(Progress& progress, double t, std::int64_t step) {
  HistoryRow history;
  history.t = t;
  history.step = step;
  history.surface_nodes = 110;
  DropRow drop;
  drop.shape.D = 0.125;
  drop.volume_drift = -2e-14;
  testing::internal::CaptureStdout();
  progress.show(history, {drop});
  return testing::internal::GetCapturedStdout();
}

TEST(Progress, PrintsTheFirstAndTheLastLineAndNotEachBetween) {
  Progress progress(0.0, 2.0, false);
  const std::string first = shown(progress, 1.0, 7);
  EXPECT_EQ(first.substr(0, 22), "[##########..........]");
  EXPECT_NE(first.find("t 1.000/2  step 7  nodes 110+0  D 0.1250  drift 2e-14"), std::string::npos)
      << first;
  EXPECT_EQ(first.back(), '\n');
  EXPECT_EQ(shown(progress, 1.1, 8), "");
  EXPECT_EQ(shown(progress, 2.0, 9).substr(0, 22), "[####################]");
}

TEST(Progress, CountsFromWhereARunIsTakenUp) {
  Progress progress(1.0, 2.0, false);
  EXPECT_EQ(shown(progress, 1.25, 9).substr(0, 22), "[#####...............]");
}

TEST(Progress, QuietPrintsNothing) {
  Progress progress(0.0, 2.0, true);
  EXPECT_EQ(shown(progress, 2.0, 9), "");
  testing::internal::CaptureStdout();
  progress.say("done");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace meniscus
