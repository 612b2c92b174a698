// Assertions are on in this file whatever the build type.
#ifndef MENISCUS_ASSERTIONS
#define MENISCUS_ASSERTIONS
#endif
#include "meniscus/core/error.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TEST(RejectInput, ThrowsTheFormattedLine) {
  try {
    reject_input("{}:{}: drop.radius = {} must be positive", "shear.toml", 14, -0.5);
    FAIL() << "did not throw";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "shear.toml:14: drop.radius = -0.5 must be positive");
  }
}

TEST(RejectInput, LeavesBracesInValuesAlone) {
  try {
    reject_input("unknown key `{}`", "{drop}");
    FAIL() << "did not throw";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "unknown key `{drop}`");
  }
}

TEST(Errors, TheUsersMistakeIsNotAFailureOfTheRun) {
  static_assert(!std::is_base_of_v<RunFailure, InvalidInput>);
  static_assert(!std::is_base_of_v<InvalidInput, RunFailure>);
  EXPECT_THROW(throw RunFailure("disk full"), std::runtime_error);
}

TEST(Assertions, PassSilentlyAndEvaluateOnce) {
  int evaluations = 0;
  MENISCUS_ASSERT(++evaluations > 0, "evaluations {}", evaluations);
  EXPECT_EQ(evaluations, 1);
}

TEST(AssertionsDeathTest, PrintTheExpressionThePlaceAndTheValues) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const int faces = 7;
  EXPECT_DEATH(MENISCUS_ASSERT(faces % 2 == 0, "{} faces", faces),
               "error_test.cpp:[0-9]+: broken invariant: faces % 2 == 0 \\[7 faces\\]");
}

}  // namespace
}  // namespace meniscus
