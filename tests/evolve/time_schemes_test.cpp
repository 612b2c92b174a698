// Order of the schemes, and what their estimates say, with a flow that tension drives.
#include "meniscus/evolve/time_schemes.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"

namespace meniscus {
namespace {

/// D of the second moments at t = 0.8, never remeshed.
double deformation(const test::UnboundedDrop& drop, TimeScheme scheme, double dt) {
  const Case c = test::unbounded_case(drop);
  double D = 0.0;
  const Report report = test::run(
      c, build_scene(c),
      [&](EvolutionOptions& options) {
        options.scheme = scheme;
        options.max_step = dt;
        options.step_factor = 1e3;
        options.end = 0.8 - 1e-9;
        options.remesh_every = 1000000;
      },
      [&](const Evolution& evolution) {
        EXPECT_TRUE(evolution.notices().empty());
        D = evolution.drop_rows()[0].shape.D_inertia;
      });
  EXPECT_TRUE(report.ok()) << report.text();
  return D;
}

/// The order that four step lengths show, each half of the one before.
double order(const test::UnboundedDrop& drop, TimeScheme scheme, double dt) {
  std::vector<double> D;
  for (int k = 0; k < 4; ++k, dt *= 0.5) D.push_back(deformation(drop, scheme, dt));
  return 0.5 * std::log2((D[0] - D[1]) / (D[2] - D[3]));
}

TEST(TimeSchemes, AreOfSecondOrderForADropThatTensionAndFlowDeform) {
  const test::UnboundedDrop relaxing{.lambda = 0.1, .nodes = 60},
      sheared{.flow = "simple-shear", .Ca = 0.3, .shape = "radius = 1.0", .nodes = 110};
  EXPECT_NEAR(order(relaxing, TimeScheme::rk2, 0.4), 2.0, 0.2);
  EXPECT_NEAR(order(relaxing, TimeScheme::rkc, 0.2), 2.0, 0.2);
  EXPECT_NEAR(order(sheared, TimeScheme::rk2, 0.1), 2.0, 0.2);
  EXPECT_NEAR(order(sheared, TimeScheme::rkc, 0.2), 2.0, 0.2);
}

// The liquid carries waves over the mesh of a steady drop. Stages that bear decay alone would let
// them grow: the estimate stayed above 0.005.
TEST(TimeSchemes, ADropInShearComesToRestByChebyshevStages) {
  const Case c = test::unbounded_case({.flow = "simple-shear",
                                       .Ca = 0.25,
                                       .shape = "radius = 1.0",
                                       .lambda = 0.1,
                                       .more = "[time]\nscheme = \"rkc\"\ntolerance = 0.5\n"});
  double error = 1.0, dt = 0.0;
  const Report report = test::run(
      c, build_scene(c), [](EvolutionOptions& options) { options.end = 6.0; },
      [&](const Evolution& evolution) {
        const HistoryRow row = evolution.rows().history;
        error = row.step_error.value_or(1.0);
        dt = row.dt;
      });
  EXPECT_TRUE(report.ok()) << report.text();
  EXPECT_LT(error, 0.001);
  EXPECT_GT(dt, 0.25);
}

/// D of an ellipsoid that relaxes, at t = 1. A jump of the flow from rest to rest ends a step
/// there.
struct Relaxed {
  double D = 0.0, largest_estimate = 0.0;
};
Relaxed relaxed(TimeScheme scheme, double tolerance) {
  const Case c =
      test::unbounded_case({.lambda = 0.1,
                            .nodes = 60,
                            .more = "[[flow.schedule]]\ntime = 1.0\nkind = \"quiescent\"\n"});
  Relaxed result;
  const Report report = test::run(
      c, build_scene(c),
      [&](EvolutionOptions& options) {
        options.scheme = scheme;
        options.control = StepControl::error;
        options.tolerance = tolerance;
        options.max_step = 1.0;
        options.end = 1.0;
        options.remesh_every = 1000000;
      },
      [&](const Evolution& evolution) {
        result.D = evolution.drop_rows()[0].shape.D_inertia;
        if (const auto error = evolution.rows().history.step_error)
          result.largest_estimate = std::max(result.largest_estimate, *error);
        if (evolution.is_finished()) {
          EXPECT_EQ(evolution.t(), 1.0);
        }
      });
  EXPECT_TRUE(report.ok()) << report.text();
  return result;
}

// Error at a fixed time ~ Δt², and so is the estimate. Steps that end at a jump, and those limited
// by growth, leave a factor of 2 of that.
TEST(TimeSchemes, ErrorFollowsTheTolerance) {
  for (const TimeScheme scheme : {TimeScheme::rk2, TimeScheme::rkc}) {
    const double exact = relaxed(scheme, 1e-4).D;
    double before = 0.0;
    for (const double tolerance : {0.02, 0.005, 0.00125}) {
      const Relaxed run = relaxed(scheme, tolerance);
      const double error = std::abs(run.D - exact);
      EXPECT_LE(run.largest_estimate, tolerance);
      EXPECT_GT(run.largest_estimate, 0.2 * tolerance);
      if (before > 0.0) {
        EXPECT_LT(error, before / 2.0);
        EXPECT_GT(error, before / 8.0);
      }
      before = error;
    }
  }
}

// A stage of a step over the beginning of a ramp may not see it.
TEST(TimeSchemes, StepsEndAtTheEndsOfARamp) {
  const Case c = test::unbounded_case(
      {.lambda = 0.1,
       .nodes = 60,
       .more = "[[flow.schedule]]\ntime = 1.0\nramp = 0.5\nkind = \"quiescent\"\n"});
  std::vector<double> times;
  const Report report = test::run(
      c, build_scene(c),
      [&](EvolutionOptions& options) {
        options.control = StepControl::error;
        options.max_step = 1.0;
        options.end = 2.0;
      },
      [&](const Evolution& evolution) { times.push_back(evolution.t()); });
  EXPECT_TRUE(report.ok()) << report.text();
  for (const double t : {1.0, 1.5}) EXPECT_EQ(std::ranges::count(times, t), 1) << t;
}

}  // namespace
}  // namespace meniscus
