#include "meniscus/core/cube_root.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TEST(CubeRoot, IsTheLibrarysButForRoundoff) {
  for (double x = 1e-290; x < 1e290; x *= 1.0137)
    EXPECT_NEAR(cube_root(x) / std::cbrt(x), 1.0, 2e-15) << x;
}

TEST(CubeRoot, PassesOnWhatIsNoNumber) {
  EXPECT_EQ(cube_root(0.0), 0.0);
  EXPECT_TRUE(std::isnan(cube_root(std::nan(""))));
}

}  // namespace
}  // namespace meniscus
