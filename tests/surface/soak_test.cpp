#include "tests/surface/soak.hpp"

#include <gtest/gtest.h>

namespace meniscus::test {
namespace {

// The first surfaces of the full soak of 10,000 (bench/remesh_soak.cpp), judged by its bounds.
TEST(RemeshSoak, RandomSurfacesStayFit) {
  SoakResult total;
  for (unsigned seed = 0; seed < 9; ++seed) {
    const SoakResult one = soak(seed);
    for (const std::string& line : one.log) ADD_FAILURE() << "seed " << seed << ": " << line;
    add(total, one);
  }
  EXPECT_EQ(total.rollbacks, 0);
  EXPECT_EQ(total.invalid, 0);
  EXPECT_LT(total.law_error, 0.05);
  EXPECT_LT(total.count_error, 0.05);
  EXPECT_LE(static_cast<double>(total.faces_below), 1e-3 * static_cast<double>(total.faces));
  EXPECT_GT(total.min_angle_deg, 5.0);
}

}  // namespace
}  // namespace meniscus::test
