#include "tests/topology/event_soak.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TEST(EventSoak, OfRandomScenesLeavesSoundDropsAndEveryVolume) {
  for (const unsigned seed : {1U, 2U}) {
    const test::EventSoak soak = test::event_soak(seed, 3, 150);
    EXPECT_EQ(soak.fault, "");
    EXPECT_GT(soak.breakups + soak.coalescences, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace meniscus
