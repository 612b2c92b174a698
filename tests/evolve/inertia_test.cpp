#include <cmath>

#include <gtest/gtest.h>

#include "tests/evolve/boundary_integral_run.hpp"
#include "tests/evolve/oscillating_drop.hpp"

namespace meniscus::test {
namespace {

const OscillatingDrop kSmallDrop{
    .of = {.La = 100.0, .b = 5.0}, .guess = {0.059, 0.174}, .nodes = 60, .steps = 24.0};

TEST(InertialDrop, OscillatesNearlyAtTheModesRate) {
  OscillatingDrop drop = kSmallDrop;
  drop.nodes = 110;
  const std::complex<double> exact = OscillationMode(drop.of, drop.guess).rate(),
                             found = fitted_rate(drop);
  EXPECT_NEAR(found.real() / exact.real(), 1.0, 0.03);
  EXPECT_NEAR(found.imag() / exact.imag(), 1.0, 0.01);
}

TEST(InertialDrop, IsOfSecondOrderInTime) {
  std::vector<double> f;
  for (const double steps : {12.0, 24.0, 48.0}) {
    OscillatingDrop drop = kSmallDrop;
    drop.steps = steps;
    drop.periods = 0.5;
    f.push_back(last_height(drop));
  }
  EXPECT_NEAR(std::log2((f[0] - f[1]) / (f[1] - f[2])), 2.0, 0.3);
}

constexpr const char* kBubble =
    "[flow]\nkind = \"quiescent\"\nreynolds-number = 20\ngravity = [0, -2, 0]\n"
    "[[drop]]\nradius = 1\nnodes = 60\nviscosity-ratio = 0.5\ndensity-ratio = 0.2\n"
    "[domain]\nhalf-width = 3\nnodes = 150\n[time]\nend = 4\n";

Evolution bubble() {
  const Case c = parse_case(kBubble, "bubble.toml");
  return {build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c)};
}

void step(Evolution& evolution) {
  const Report solved = evolution.solve();
  ASSERT_TRUE(solved.ok()) << solved.text();
  const Report advanced = evolution.advance();
  ASSERT_TRUE(advanced.ok()) << advanced.text();
}

TEST(InertialDrop, RisesWithTheBooksInBalance) {
  Evolution evolution = bubble();
  ASSERT_TRUE(evolution.prepare().ok());
  while (!evolution.is_finished()) step(evolution);
  ASSERT_TRUE(evolution.solve().ok());
  const Evolution::Rows rows = evolution.rows();
  EXPECT_GT(rows.drops[0].motion->velocity.y(), 0.01);
  EXPECT_GT(rows.drops[0].motion->reynolds, 0.4);
  EXPECT_GT(rows.history.kinetic->energy, 0.0);
  EXPECT_LT(std::abs(*rows.history.power_residual()), 0.03 * *rows.history.power_in);
}

TEST(InertialDrop, GoesOnFromACheckpointToTheSameBits) {
  Evolution whole = bubble();
  ASSERT_TRUE(whole.prepare().ok());
  for (int k = 0; k < 3; ++k) step(whole);
  Archive archive;
  whole.save(archive);
  Evolution resumed = bubble();
  resumed.load(archive);
  Archive at_end, at_end_too;
  step(whole);
  step(resumed);
  whole.save(at_end);
  resumed.save(at_end_too);
  EXPECT_EQ(at_end.reals, at_end_too.reals);
  EXPECT_EQ(at_end.integers, at_end_too.integers);
}

}  // namespace
}  // namespace meniscus::test
