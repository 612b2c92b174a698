#include "meniscus/scene/region_sources.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

const RegionId kMatrix{0}, kFirst{1}, kSecond{2}, kThird{3};

RegionSources sources_of(std::vector<std::vector<RegionId>> sources) {
  return RegionSources(std::move(sources));
}

TEST(RegionSources, AreAsTheyWereWhereNothingChanges) {
  const RegionSources some = sources_of({{kMatrix}, {kFirst, kSecond}});
  EXPECT_EQ(joined_sources(some, {}), some);
  EXPECT_EQ(joined_sources({}, some), some);
}

// The first drop breaks in two, and the second of these takes up another drop: liquid of both.
TEST(RegionSources, FollowLiquidThroughACutAndAMerger) {
  const RegionSources cut = sources_of({{kMatrix}, {kSecond}, {kFirst}, {kFirst}});
  const RegionSources merger = sources_of({{kMatrix}, {kSecond}, {kFirst, kThird}});
  EXPECT_EQ(joined_sources(cut, merger), sources_of({{kMatrix}, {kFirst}, {kFirst, kSecond}}));
}

}  // namespace
}  // namespace meniscus
