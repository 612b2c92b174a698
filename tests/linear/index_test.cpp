#include "meniscus/linear/index.hpp"

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"

namespace meniscus::linear {
namespace {

TEST(CheckedIndex, KeepsWhatFitsAndRefusesTheNextInWords) {
  EXPECT_EQ(checked_index(0, "entries"), 0);
  EXPECT_EQ(checked_index(2147483647, "entries"), 2147483647);
  try {
    (void)checked_index(2147483648, "matrix entries");
    FAIL() << "2^31 was accepted";
  } catch (const RunFailure& failure) {
    EXPECT_STREQ(failure.what(),
                 "the flow problem has 2147483648 matrix entries on one process: at most "
                 "2147483647 can be numbered with 32 bits; use more processes or a coarser mesh");
  }
}

}  // namespace
}  // namespace meniscus::linear
