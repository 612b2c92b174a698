#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/evolve/boundary_integral_run.hpp"
#include "tests/evolve/damped_drop.hpp"

namespace meniscus::test {
namespace {

using fem::Elements;

class SemiImplicit : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, SemiImplicit, testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST(SemiImplicit, IsOfSecondOrderInTime) {
  for (const double order : orders_in_relaxation(Elements::p1_p1)) EXPECT_NEAR(order, 2.0, 0.2);
  for (const double order : orders_in_shear(Elements::p1_p1)) EXPECT_NEAR(order, 2.0, 0.2);
}

// Ten times what explicit steps bear, from an ellipsoid with noise on its vertices.
TEST_P(SemiImplicit, IsStableAtLongSteps) {
  const std::vector<double> excess =
      excesses({.elements = GetParam(),
                .num_vertices = GetParam() == Elements::p1_p1 ? 200 : 110,
                .noise = 0.01},
               12);
  for (std::size_t k = 1; k < excess.size() && excess[k - 1] > 1e-3; ++k)
    EXPECT_LT(excess[k], excess[k - 1]) << "step " << k;
  // The slowest mode keeps at most |R(∞)| = 0.732 of its height in a step: a = ½ + 1/√12.
  EXPECT_LT(excess[8], std::pow(0.732, 16));
}

// The wind carries a drop that relaxes on the way: three eighths of its radius a step.
TEST_P(SemiImplicit, CarriesADropWithoutLag) {
  Evolution evolution =
      evolution_of({.elements = GetParam(), .D = 0.2, .wind = Vec3::UnitX()}, 0.4);
  run(evolution, 0.8);
  EXPECT_NEAR(centroid_in(evolution).x() / evolution.t(), 1.0, 0.003);
}

// In a liquid that turns as a whole a drop turns with it, whatever its shape does.
TEST_P(SemiImplicit, TurnsADropWithoutLag) {
  const Mat3 turning = simple_shear().transpose() - simple_shear();
  Evolution evolution =
      evolution_of({.elements = GetParam(), .Ca = 20.0, .D = 1.0 / 3.0, .gradient = turning}, 0.4);
  run(evolution, 0.8);
  EXPECT_NEAR(angle_in(evolution) / evolution.t(), 1.0, 0.003);
}

// Tension turns a sheared drop back to its angle, at nine times the rate of shear here. Remeshing
// moves it off by a little each time. Steps are as long as slip allows.
TEST(SemiImplicit, ShearedDropsKeepTheirAngle) {
  std::array<double, 2> angle{};
  for (const bool is_damped : {false, true}) {
    const Case c = unbounded_case(
        {.flow = "simple-shear",
         .Ca = 0.05,
         .shape = "radius = 1.0",
         .more = fmt::format("[time]\nend = 5.0\nscheme = \"{}\"\n[interface]\nremesh-every = 5\n",
                             is_damped ? "semi-implicit" : "rkc")});
    const Report report = run(
        c, build_scene(c), [](EvolutionOptions&) {},
        [&](const Evolution& evolution) {
          angle[is_damped] = evolution.rows().drops[0].shape.angle_deg.value();
        });
    ASSERT_TRUE(report.ok()) << report.text();
  }
  EXPECT_NEAR(angle[1], angle[0], 0.1);
}

// Off the plane of no flow the drop goes with the shear there.
TEST(SemiImplicit, CarriesADropInShear) {
  const DampedDrop drop{
      .Ca = 0.2, .D = 0.0, .center = Vec3(0.0, 0.5, 0.0), .gradient = simple_shear()};
  Evolution damped = evolution_of(drop, 0.2), short_steps = evolution_of(drop, 0.02);
  run(damped, 0.8);
  run(short_steps, 0.8);
  EXPECT_GT(centroid_in(short_steps).x(), 0.3);
  EXPECT_NEAR(centroid_in(damped).x() / centroid_in(short_steps).x(), 1.0, 0.003);
}

TEST(SemiImplicit, GoesOnFromACheckpointBitForBit) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    const DampedDrop drop{
        .elements = elements, .num_vertices = 60, .Ca = 0.3, .gradient = simple_shear()};
    Evolution whole = evolution_of(drop, 0.1);
    run(whole, 0.2);
    Archive between;
    whole.save(between);
    Evolution resumed = evolution_of(drop, 0.1);
    resumed.load(between);
    run(whole, 0.4);
    run(resumed, 0.4);
    EXPECT_EQ(whole.scene().interfaces[0].mesh.x, resumed.scene().interfaces[0].mesh.x);
    Archive a, b;
    whole.save(a);
    resumed.save(b);
    EXPECT_EQ(a.reals, b.reals);
    EXPECT_EQ(a.integers, b.integers);
  }
}

}  // namespace
}  // namespace meniscus::test
