#include "meniscus/evolve/energy_check.hpp"

#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"
#include "meniscus/core/log.hpp"

namespace meniscus {
namespace {

struct Outcome {
  Report report;
  DropShape shape;
  int refusals = 0;  ///< because of the energy or the error
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

// At 5 edges per capillary time the midpoint rule amplifies short waves threefold a step for λ =
// 0.1: left alone, the run ends with H_max = 13 and D = 0.046.
TEST(EnergyCheck, ARelaxingDropIsRightAfterStepsThatAreTooLong) {
  const test::UnboundedDrop ellipsoid{.lambda = 0.1};
  const Outcome longer = outcome(ellipsoid, 5.0, 8.0), shorter = outcome(ellipsoid, 0.5, 8.0);
  ASSERT_TRUE(longer.report.ok()) << longer.report.text();
  EXPECT_GE(longer.refusals, 1);
  EXPECT_EQ(shorter.refusals, 0);
  EXPECT_NEAR(longer.shape.D, shorter.shape.D, 0.01);
  EXPECT_NEAR(longer.shape.H_max, shorter.shape.H_max, 0.05 * shorter.shape.H_max);
}

TEST(EnergyCheck, AShearedDropIsRightAfterStepsThatAreTooLong) {
  const test::UnboundedDrop sheared{
      .flow = "simple-shear", .Ca = 0.2, .shape = "radius = 1.0", .lambda = 0.1};
  const Outcome longer = outcome(sheared, 8.0, 4.0), shorter = outcome(sheared, 0.5, 4.0);
  ASSERT_TRUE(longer.report.ok()) << longer.report.text();
  EXPECT_GE(longer.refusals, 1);
  EXPECT_EQ(shorter.refusals, 0);
  EXPECT_NEAR(longer.shape.D, shorter.shape.D, 0.01);
  EXPECT_NEAR(longer.shape.H_max, shorter.shape.H_max, 0.05 * shorter.shape.H_max);
}

TEST(EnergyCheck, ARunThatMayNotShortenItsStepsEndsWithWords) {
  const Outcome stopped = outcome({.lambda = 0.1}, 3.5, 20.0, 0.7);
  EXPECT_FALSE(stopped.report.ok());
  EXPECT_NE(stopped.report.text().find("no step of length 0.7"), std::string::npos)
      << stopped.report.text();
}

}  // namespace
}  // namespace meniscus
