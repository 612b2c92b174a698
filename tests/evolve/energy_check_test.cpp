#include "meniscus/evolve/energy_check.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"
#include "meniscus/core/log.hpp"

namespace meniscus {
namespace {

// A sphere with a wave of degree 6 and height a, that decays at the rate r.
constexpr double kHeight = 0.02, kRate = 1.0;

double wave(const Vec3& x) {
  const double c = x.normalized().x();
  return (231.0 * std::pow(c, 6) - 315.0 * std::pow(c, 4) + 105.0 * c * c - 5.0) / 16.0;
}

Scene wavy_sphere(double height) {
  Scene scene = build_scene(test::unbounded_case({.shape = "radius = 1.0"}));
  for (Vec3& x : scene.interfaces[0].mesh.x) x *= 1.0 + height * wave(x);
  return scene;
}

/// What the check says of a step of the midpoint rule, of length z/r.
std::optional<Fault> fault_of_midpoint_step(double z, bool damps_waves) {
  const double middle = kHeight * (1.0 - 0.5 * z), end = kHeight - z * middle;
  const Scene start = wavy_sphere(kHeight), halfway = wavy_sphere(middle);
  StageFlow whole;
  VertexField<Vec3>& motion = whole.motion.emplace_back();
  for (const Vec3& x : start.interfaces[0].mesh.x)
    motion.add(-kRate * middle * wave(x) * x.normalized());
  whole.surface_rate = surface_energy_rate(halfway, whole.motion);
  whole.damps_waves = damps_waves;
  Carriers carriers(SurfaceShape::faceted);
  return find_energy_fault({start, 0.0, z / kRate, carriers}, whole, wavy_sphere(end));
}

TEST(EnergyCheck, FindsAWaveThatAStepAmplifies) {
  EXPECT_FALSE(fault_of_midpoint_step(0.2, false));
  for (const bool damps_waves : {false, true})
    EXPECT_TRUE(fault_of_midpoint_step(3.5, damps_waves));
}

struct Outcome {
  Report report;
  DropShape shape;
  int refusals = 0;  ///< because of the energy or the error
  int held = 0;      ///< steps that stability shortened
};

/// Runs that warn on purpose.
Outcome outcome(const test::UnboundedDrop& drop, double step_factor, double end,
                double min_step = 1e-6) {
  log::set_level(log::Level::off);
  const Case c = test::unbounded_case(drop);
  Outcome result;
  EvolutionOptions options = c.evolution;
  options.step_factor = step_factor;
  options.max_step = 10.0;
  options.min_step = min_step;
  options.end = end;
  Evolution evolution(build_scene(c), options, make_flow_solver(c));
  result.report = evolution.prepare();
  while (result.report.ok()) {
    result.report = evolution.solve();
    if (evolution.rows().history.step_bound == StepBound::stability) ++result.held;
    if (evolution.is_finished() || !result.report.ok()) break;
    result.report = evolution.advance();
  }
  result.shape = evolution.drop_rows()[0].shape;
  for (const Notice& notice : evolution.notices())
    if (const auto* step = std::get_if<RefusedStep>(&notice.what))
      result.refusals += step->why.find("energy") != std::string::npos ||
                                 step->why.find("its error") != std::string::npos
                             ? 1
                             : 0;
  log::set_level(log::Level::warning);
  return result;
}

/// Steps by the paper's rule with a factor that explicit schemes cannot bear end as those with ½.
void expect_the_same(const Outcome& longer, const Outcome& shorter) {
  ASSERT_TRUE(longer.report.ok()) << longer.report.text();
  EXPECT_GE(longer.held, 1);
  EXPECT_EQ(shorter.held, 0);
  EXPECT_EQ(shorter.refusals, 0);
  EXPECT_NEAR(longer.shape.D, shorter.shape.D, 0.01);
  EXPECT_NEAR(longer.shape.H_max, shorter.shape.H_max, 0.05 * shorter.shape.H_max);
}

// At 5 edges per capillary time the midpoint rule would amplify short waves threefold a step for
// λ = 0.1.
TEST(EnergyCheck, ARelaxingDropIsRightWhereStepsAskedForAreTooLong) {
  const test::UnboundedDrop ellipsoid{.lambda = 0.1};
  expect_the_same(outcome(ellipsoid, 5.0, 8.0), outcome(ellipsoid, 0.5, 8.0));
}

TEST(EnergyCheck, AShearedDropIsRightWhereStepsAskedForAreTooLong) {
  const test::UnboundedDrop sheared{
      .flow = "simple-shear", .Ca = 0.2, .shape = "radius = 1.0", .lambda = 0.1};
  expect_the_same(outcome(sheared, 8.0, 4.0), outcome(sheared, 0.5, 4.0));
}

TEST(EnergyCheck, ARunThatMayNotShortenItsStepsEndsWithWords) {
  const Outcome stopped = outcome({.lambda = 0.1}, 3.5, 20.0, 0.7);
  EXPECT_FALSE(stopped.report.ok());
  EXPECT_NE(stopped.report.text().find("no step of length 0.7"), std::string::npos)
      << stopped.report.text();
}

}  // namespace
}  // namespace meniscus
