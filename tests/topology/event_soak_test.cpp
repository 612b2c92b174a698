#include "tests/topology/event_soak.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TEST(EventSoak, OfRandomScenesLeavesSoundDropsAndEveryVolume) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const test::EventSoak soak = test::event_soak(seed, 4, 150);
    EXPECT_EQ(soak.fault, "");
    EXPECT_GE(soak.breakups + soak.coalescences, 4) << "seed " << seed;
  }
}

}  // namespace
}  // namespace meniscus
