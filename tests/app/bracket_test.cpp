#include "meniscus/app/bracket.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

using Result = Bracket::Result;
using testing::ElementsAre;

StudyBisection search(double from, double to, double tolerance = 0.01,
                      bool is_logarithmic = false) {
  StudyBisection bisection;
  bisection.from = from;
  bisection.to = to;
  bisection.tolerance = tolerance;
  bisection.is_logarithmic = is_logarithmic;
  return bisection;
}

/// Tries what is wanted until nothing is.
Bracket finished(const StudyBisection& bisection, const std::function<Verdict(double)>& verdict) {
  Bracket bracket(bisection);
  while (const auto value = bracket.wanted()) bracket.add(*value, verdict(*value));
  return bracket;
}

std::function<Verdict(double)> critical_at(double critical) {
  return [critical](double value) { return value < critical ? Verdict::steady : Verdict::broken; };
}

std::vector<double> tried(const Bracket& bracket) {
  std::vector<double> values;
  for (const auto& [value, verdict] : bracket.verdicts()) values.push_back(value);
  return values;
}

TEST(Bracket, BeginsWithTheEndFromAndHalves) {
  Bracket bracket(search(0.1, 0.2));
  EXPECT_EQ(bracket.wanted(), 0.1);
  bracket.add(0.1, Verdict::steady);
  EXPECT_EQ(bracket.wanted(), 0.15);
  EXPECT_FALSE(bracket.middle());  // none is known to break
  bracket.add(0.15, Verdict::broken);
  EXPECT_EQ(bracket.middle(), 0.125);
  EXPECT_EQ(bracket.wanted(), 0.125);
  EXPECT_EQ(bracket.result(), Result::open);
}

TEST(Bracket, TriesTheEndToOnlyWhereThreeMiddlesAgreeWithFrom) {
  EXPECT_THAT(tried(finished(search(0.0, 16.0, 0.2), critical_at(13.0))),
              ElementsAre(0.0, 8.0, 12.0, 14.0));
  EXPECT_THAT(tried(finished(search(0.0, 16.0, 0.2), critical_at(15.5))),
              ElementsAre(0.0, 8.0, 12.0, 14.0, 16.0));
  EXPECT_THAT(tried(finished(search(0.0, 16.0, 0.2), critical_at(17.0))),
              ElementsAre(0.0, 8.0, 12.0, 14.0, 16.0));
  // From large values down to small ones.
  EXPECT_THAT(tried(finished(search(16.0, 0.5, 0.1), critical_at(0.1))),
              ElementsAre(0.5, 2.4375, 4.375, 8.25, 16.0));
}

TEST(Bracket, TriesTheEndToOnceTheBracketIsNarrow) {
  EXPECT_THAT(tried(finished(search(0.05, 0.2, 0.3), critical_at(0.19))),
              ElementsAre(0.05, 0.125, 0.1625, 0.2));
  EXPECT_THAT(tried(finished(search(0.12, 0.121, 0.01), critical_at(0.1205))),
              ElementsAre(0.12, 0.121));
}

TEST(Bracket, EndsAlsoWhereNoNumberOfSixDigitsLiesBetween) {
  const Bracket bracket = finished(search(0.1, 0.1000001, 1e-4), critical_at(0.2));
  EXPECT_EQ(bracket.result(), Result::all_steady);
}

TEST(Bracket, ClosesInOnTheCriticalValueFromEitherSide) {
  for (const bool is_logarithmic : {false, true})
    for (const double critical : {0.1203, 0.0501, 0.99}) {
      const Bracket up = finished(search(0.05, 1.0, 1e-3, is_logarithmic), critical_at(critical));
      EXPECT_EQ(up.result(), Result::critical);
      EXPECT_LT(*up.steady(), critical);
      EXPECT_GE(*up.broken(), critical);
      EXPECT_LE(*up.relative_width(), 1e-3);
      EXPECT_GE(*up.middle(), *up.steady());
      // Large values steady, small ones broken, as for a viscosity.
      const Bracket down = finished(search(0.05, 1.0, 1e-3, is_logarithmic), [&](double value) {
        return value < critical ? Verdict::broken : Verdict::steady;
      });
      EXPECT_GE(*down.steady(), critical);
      EXPECT_LT(*down.broken(), critical);
      EXPECT_LE(*down.relative_width(), 1e-3);
    }
}

TEST(Bracket, TheSearchOfRatiosHalvesThem) {
  Bracket bracket(search(0.01, 1.0, 0.01, true));
  bracket.add(0.01, Verdict::steady);
  bracket.add(1.0, Verdict::broken);
  EXPECT_EQ(bracket.wanted(), 0.1);
}

TEST(Bracket, EndsThatAgreeHaveNoCriticalValueBetween) {
  const Bracket steady = finished(search(0.1, 2.0), critical_at(5.0));
  EXPECT_EQ(steady.result(), Result::all_steady);
  EXPECT_EQ(steady.steady(), 2.0);
  EXPECT_FALSE(steady.broken());
  EXPECT_FALSE(steady.middle());
  const Bracket broken = finished(search(0.1, 2.0), critical_at(0.01));
  EXPECT_EQ(broken.result(), Result::all_broken);
  EXPECT_FALSE(broken.steady());
}

TEST(Bracket, AnUndecidedOrFailedRunEndsTheSearchWithTheBracketSoFar) {
  for (const auto& [verdict, result] : {std::pair(Verdict::undecided, Result::undecided),
                                        std::pair(Verdict::failed, Result::failed)}) {
    const Bracket bracket = finished(search(0.1, 0.2), [&, verdict = verdict](double value) {
      return value == 0.125 ? verdict : critical_at(0.12)(value);
    });
    EXPECT_EQ(bracket.result(), result);
    EXPECT_EQ(bracket.steady(), 0.1);
    EXPECT_EQ(bracket.broken(), 0.15);
    EXPECT_FALSE(bracket.wanted());
  }
}

TEST(Bracket, AnEndThatFailedOrIsUndecidedEndsTheSearch) {
  for (const auto& [verdict, result] : {std::pair(Verdict::undecided, Result::undecided),
                                        std::pair(Verdict::failed, Result::failed)}) {
    Bracket bracket(search(0.1, 0.2));
    bracket.add(0.1, verdict);
    EXPECT_FALSE(bracket.wanted());
    EXPECT_EQ(bracket.result(), result);
    EXPECT_FALSE(bracket.steady());
    EXPECT_FALSE(bracket.broken());
  }
}

// The verdicts decide, not the order in which runs end.
TEST(Bracket, DoesNotDependOnTheOrderOfVerdicts) {
  const auto verdict = critical_at(0.137);
  const Bracket first = finished(search(0.1, 0.2), verdict);
  Bracket reversed(search(0.1, 0.2));
  for (auto each = first.verdicts().rbegin(); each != first.verdicts().rend(); ++each)
    reversed.add(each->first, each->second);
  EXPECT_EQ(reversed.result(), first.result());
  EXPECT_EQ(reversed.steady(), first.steady());
  EXPECT_EQ(reversed.broken(), first.broken());
}

}  // namespace
}  // namespace meniscus
