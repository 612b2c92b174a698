// What is said of a drop that an extensional flow carries off.
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"

namespace meniscus {
namespace {

/// The departures that a run tells of, of a drop that begins off the centre.
std::vector<LeftCenter> departures(const std::string& flow, const std::string& center,
                                   bool follows_drops = false) {
  const Case c = test::unbounded_case({.flow = flow,
                                       .Ca = 0.05,
                                       .shape = "radius = 1.0\ncenter = " + center,
                                       .nodes = 42,
                                       .more = "[time]\nend = 4.0\n"});
  std::vector<LeftCenter> told;
  const Report report = test::run(
      c, build_scene(c), [&](EvolutionOptions& options) { options.follows_drops = follows_drops; },
      [&](const Evolution& evolution) {
        if (!evolution.is_finished()) return;
        for (const Notice& notice : evolution.notices())
          if (const auto* left = std::get_if<LeftCenter>(&notice.what)) told.push_back(*left);
      });
  EXPECT_TRUE(report.ok()) << report.text();
  return told;
}

TEST(Departure, IsToldOnceWhereTheFlowIsExtensional) {
  for (const char* flow : {"planar-extension", "uniaxial-extension"}) {
    const auto told = departures(flow, "[0.1, 0, 0]");  // it has gone 0.1 (e^t − 1)
    ASSERT_EQ(told.size(), 1U) << flow;
    EXPECT_GT(told[0].distance, 1.0);
    EXPECT_LT(told[0].distance, 3.0);
  }
}

TEST(Departure, IsNotToldInShearNorOfDropsThatAreFollowed) {
  EXPECT_TRUE(departures("simple-shear", "[0, 1, 0]").empty());  // it has gone 4
  EXPECT_TRUE(departures("planar-extension", "[0.1, 0, 0]", true).empty());
}

}  // namespace
}  // namespace meniscus
