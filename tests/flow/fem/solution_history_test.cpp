#include "meniscus/flow/fem/solution_history.hpp"

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

/// Two nodes and three pressures that depend on time as a + bt.
StokesState linear_in_time(double t) {
  StokesState state;
  state.v.add(Vec3(1.0 + t, 2.0, -3.0 * t));
  state.v.add(Vec3(0.0, 0.5 - 2.0 * t, t));
  state.p = {1.0, -t, 4.0 * t - 2.0};
  return state;
}

void expect_same(const StokesState& a, const StokesState& b) {
  ASSERT_EQ(a.v.size(), b.v.size());
  ASSERT_EQ(a.p.size(), b.p.size());
  for (const NodeId i : a.v.ids()) EXPECT_LT((a.v[i] - b.v[i]).norm(), 1e-14) << i.value;
  for (std::size_t i = 0; i < a.p.size(); ++i) EXPECT_NEAR(a.p[i], b.p[i], 1e-14) << i;
}

TEST(SolutionHistory, OneSolutionHoldsAtAllTimes) {
  SolutionHistory history;
  EXPECT_TRUE(history.empty());
  history.add(linear_in_time(0.7), 0.7);
  expect_same(history.at(3.0), linear_in_time(0.7));
}

TEST(SolutionHistory, TwoSolutionsGoOnAlongTheirLine) {
  SolutionHistory history;
  for (const double t : {0.1, 0.4, 0.7}) history.add(linear_in_time(t), t);
  ASSERT_EQ(history.states().size(), 2U);
  for (const double t : {0.2, 0.7, 0.9, 1.3}) expect_same(history.at(t), linear_in_time(t));
  expect_same(history.at(5.0), linear_in_time(1.3));  // no further than 0.6
}

// After a refused step the solver is asked for an earlier flow again.
TEST(SolutionHistory, MayGoBackInTime) {
  SolutionHistory history;
  for (const double t : {0.4, 0.9, 0.4}) history.add(linear_in_time(t), t);
  expect_same(history.at(0.6), linear_in_time(0.6));
}

TEST(SolutionHistory, ASolutionOfTheSameTimeTakesThePlaceOfTheLast) {
  SolutionHistory history;
  history.add(linear_in_time(0.1), 0.1);
  history.add(linear_in_time(9.0), 0.4);
  history.add(linear_in_time(0.4), 0.4);
  expect_same(history.at(0.7), linear_in_time(0.7));
}

TEST(SolutionHistory, ComesBackFromACheckpoint) {
  SolutionHistory history, restored;
  for (const double t : {0.1, 0.4}) history.add(linear_in_time(t), t);
  Archive archive;
  history.save(archive);
  restored.load(archive, linear_in_time(0.0));
  expect_same(restored.at(0.8), linear_in_time(0.8));

  // Checkpoints of old have one, without its time.
  Archive old = archive;
  for (const char* name : {"flow/guess/time", "flow/guess/before/time",
                           "flow/guess/before/velocity", "flow/guess/before/pressure"})
    old.reals.erase(name);
  restored.load(old, linear_in_time(0.0));
  expect_same(restored.at(0.8), linear_in_time(0.4));
  restored.add(linear_in_time(0.7), 0.7);
  expect_same(restored.at(0.8), linear_in_time(0.7));

  Archive timeless = archive;
  timeless.reals.erase("flow/guess/time");
  EXPECT_THROW(restored.load(timeless, linear_in_time(0.0)), InvalidInput);
  timeless.reals["flow/guess/time"] = timeless.reals["flow/guess/before/time"];
  EXPECT_THROW(restored.load(timeless, linear_in_time(0.0)), InvalidInput);

  StokesState more = linear_in_time(0.0);
  more.p.push_back(0.0);
  EXPECT_THROW(restored.load(archive, more), InvalidInput);
}

}  // namespace
}  // namespace meniscus::fem
