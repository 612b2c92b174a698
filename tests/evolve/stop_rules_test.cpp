#include "meniscus/evolve/stop_rules.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/case/case.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

DropRow row(int drop, double L) {
  DropRow result;
  result.drop = drop;
  result.shape.L = L;
  return result;
}

/// The first time, of many a step `dt` apart, at which a drop of length L(t) ends its run.
std::optional<double> end_of(const StopRules& rules, const std::function<double(double)>& L,
                             Ending expected, double dt = 0.13, double last = 40.0) {
  StopJudge judge(rules);
  for (double t = 0.0; t < last; t += dt) {
    const std::vector<DropRow> drops{row(0, L(t))};
    if (const auto end = judge.judge(t, drops, {}, Scene(), {})) {
      EXPECT_EQ(end->ending, expected) << end->text;
      return t;
    }
  }
  return std::nullopt;
}

TEST(StopRules, AnExponentialApproachIsSteadyWhenItsRateIsBelowTheBound) {
  const double rate = 1e-3;
  const auto end = end_of(
      {.steady_rate = rate}, [](double t) { return 2.0 - std::exp(-t); }, Ending::steady);
  ASSERT_TRUE(end);
  // The change over the window before t is e^(1−t) − e^(−t), which is the bound at this t.
  const double exact = std::log((std::exp(kRateWindow) - 1.0) / (rate * kRateWindow));
  EXPECT_GE(*end, exact);
  EXPECT_LE(*end, exact + 0.13 + 0.02);  // one step, and what chords miss of the curve
}

TEST(StopRules, ASlowBottleneckIsNotSteadyWhileItsRateIsAboveTheBound) {
  // dL/dt = a + (L − 2)² leads past L = 2 at the rate a.
  const double a = 4e-3;
  const auto L = [&](double t) { return 2.0 + std::sqrt(a) * std::tan(std::sqrt(a) * (t - 20.0)); };
  EXPECT_FALSE(end_of({.steady_rate = 0.9 * a}, L, Ending::steady));
  EXPECT_TRUE(end_of({.steady_rate = 1.5 * a}, L, Ending::steady));
}

TEST(StopRules, GrowingSlowlyButFasterThanBeforeIsNotSteady) {
  EXPECT_FALSE(end_of(
      {.steady_rate = 1.0}, [](double t) { return 1.0 + 1e-4 * t * t; }, Ending::steady));
}

TEST(StopRules, AnOscillatingDropIsNotSteadyAtItsTurns) {
  EXPECT_FALSE(end_of(
      {.steady_rate = 1e-2}, [](double t) { return 1.0 + 0.1 * std::cos(t); }, Ending::steady,
      0.05));
}

TEST(StopRules, RunawayNeedsLengthAndARisingRate) {
  const StopRules rules{.broken_length = 3.0};
  const auto end = end_of(
      rules, [](double t) { return std::exp(0.1 * t); }, Ending::broken);
  ASSERT_TRUE(end);
  EXPECT_NEAR(*end, std::log(3.0) / 0.1, 0.13);
  // Beyond the length, and slower and slower.
  EXPECT_FALSE(end_of(
      rules, [](double t) { return 5.0 - 4.0 * std::exp(-t); }, Ending::broken));
}

TEST(StopRules, LengthAloneEndsAtItsBound) {
  const auto end = end_of(
      {.length = 1.5}, [](double t) { return 1.0 + 0.1 * t; }, Ending::length);
  ASSERT_TRUE(end);
  EXPECT_NEAR(*end, 5.0, 0.13);
}

TEST(StopRules, AnEventBreaksOnlyWhereItIsAskedTo) {
  const std::vector<TopologyEvent> events(1);
  const std::vector<DropRow> drops{row(1, 1.0), row(2, 1.0)};
  EXPECT_FALSE(StopJudge({.length = 9.0}).judge(1.0, drops, events, Scene(), {}));
  const auto end = StopJudge({.is_broken_by_event = true}).judge(1.0, drops, events, Scene(), {});
  ASSERT_TRUE(end);
  EXPECT_EQ(end->ending, Ending::broken);
}

TEST(StopRules, DropsOfAnotherNumberBeginANewRecord) {
  LengthRates rates;
  for (double t = 0.0; t < 3.0; t += 0.1) rates.add(t, {{0, 1.0}});
  EXPECT_TRUE(rates.are_steady(1e-6));
  rates.add(3.0, {{1, 0.8}, {2, 0.8}});
  EXPECT_FALSE(rates.are_steady(1e-6));
}

// A run that is taken up gives the judge the rows of its folder; it then ends where it would have.
TEST(StopRules, RowsOfAnEarlierPartCountAsIfJudged) {
  const auto L = [](double t) { return 2.0 - std::exp(-t); };
  StopJudge whole({.steady_rate = 1e-2}), resumed({.steady_rate = 1e-2});
  for (int step = 0; step < 100; ++step) {
    const double t = 0.1 * step;
    const std::vector<DropRow> drops{row(0, L(t))};
    const auto end = whole.judge(t, drops, {}, Scene(), {});
    if (step < 30) {
      resumed.past().add(t, {{0, L(t)}});
      ASSERT_FALSE(end);
    } else {
      const auto of_resumed = resumed.judge(t, drops, {}, Scene(), {});
      Archive archive;  // the judge of every step goes on from that of the last one
      resumed.past().save(archive);
      resumed = StopJudge({.steady_rate = 1e-2});
      resumed.past().load(archive);
      ASSERT_EQ(end.has_value(), of_resumed.has_value()) << t;
      if (end) return;
    }
  }
  FAIL() << "it never ended";
}

TEST(StopRules, LengthsThatDoNotFitTogetherAreRefused) {
  LengthRates rates;
  rates.add(0.0, {{3, 2.0}, {5, 2.5}});
  rates.add(0.5, {{3, 2.1}, {5, 2.4}});
  Archive archive;
  rates.save(archive);
  LengthRates read;
  read.load(archive);
  EXPECT_FALSE(read.is_empty());
  read.load(Archive());
  EXPECT_TRUE(read.is_empty());
  archive.reals.at("evolution/lengths/L").pop_back();
  EXPECT_THROW(read.load(archive), InvalidInput);
}

/// A ball of radius ½ around (x, 0, 0) in a box of half-width 2, whose right face is open.
Scene ball_in_box(double x) {
  return build_scene(parse_case(
      fmt::format("[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 0.5\ncenter = [{}, 0, 0]\n"
                  "[domain]\nhalf-width = 2\n"
                  "[[domain.patch]]\nname = \"x+\"\ncondition = \"open\"\n",
                  x),
      "case.toml"));
}

TEST(StopRules, OnlyAnOpenPatchIsComeTo) {
  EXPECT_FALSE(find_patch_contact(ball_in_box(1.3), {}, 0.1));
  EXPECT_FALSE(find_patch_contact(ball_in_box(-1.45), {}, 0.1));  // a wall
  const auto contact = find_patch_contact(ball_in_box(1.45), {}, 0.1);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->drop, 0);
  EXPECT_EQ(contact->patch, "x+");
  const StopRules near{.is_ended_by_patch = true, .patch_gap = 0.02};
  EXPECT_FALSE(StopJudge(near).judge(0.0, {}, {}, ball_in_box(1.45), {}));
  EXPECT_TRUE(StopJudge({.is_ended_by_patch = true}).judge(0.0, {}, {}, ball_in_box(1.45), {}));
}

// Without a distance of the user's the ball's own edges are it.
TEST(StopRules, APatchIsComeToWithinAnEdge) {
  const Scene probe = ball_in_box(0.0);
  const SurfaceMesh& mesh = probe.interfaces.front().mesh;
  const VertexField<double> edges = mean_edges(mesh);
  VertexId foremost{0};
  for (const VertexId v : mesh.x.ids())
    if (mesh.x[v].x() > mesh.x[foremost].x()) foremost = v;
  const double reach = mesh.x[foremost].x(), edge = edges[foremost];
  EXPECT_FALSE(find_patch_contact(ball_in_box(2.0 - reach - 1.1 * edge), {}));
  EXPECT_TRUE(find_patch_contact(ball_in_box(2.0 - reach - 0.9 * edge), {}));
}

// A step may carry a drop farther than its edges are long; the way to the patch alone counts.
TEST(StopRules, ThePatchIsForeseenAStepAhead) {
  const Scene scene = ball_in_box(0.0);
  const auto moving = [&](const Vec3& velocity) {
    return std::vector{VertexField<Vec3>(scene.interfaces.front().mesh.num_vertices(), velocity)};
  };
  const auto onwards = moving(Vec3(2, 0, 0)), back = moving(Vec3(-2, 0, 0)),
             across = moving(Vec3(0, 2, 0));
  EXPECT_TRUE(find_patch_contact(scene, {0.71, onwards}, 0.1));   // 1.5 − 1.42 < 0.1
  EXPECT_FALSE(find_patch_contact(scene, {0.69, onwards}, 0.1));  // 1.5 − 1.38 > 0.1
  EXPECT_FALSE(find_patch_contact(scene, {0.71, back}, 0.1));
  EXPECT_FALSE(find_patch_contact(scene, {0.71, across}, 0.1));
}

}  // namespace
}  // namespace meniscus
