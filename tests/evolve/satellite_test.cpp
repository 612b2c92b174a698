#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::test {
namespace {

/// Two drops in shear, with or without one of 0.012 R0 between them, half a radius off the plane
/// of no flow.
Case parents(bool with_satellite, double tolerance) {
  const std::string satellite =
      with_satellite ? "[[drop]]\ncenter = [0.0, 0.5, 0.0]\nradius = 0.012\nviscosity-ratio = 1.0\n"
                       "nodes = 110\n"
                     : "";
  return parse_case(
      fmt::format(
          "[flow]\nkind = \"simple-shear\"\ncapillary-number = 0.2\n"
          "[[drop]]\ncenter = [-3.0, 0.0, 0.0]\nradius = 1.0\nviscosity-ratio = 1.0\nnodes = 110\n"
          "[[drop]]\ncenter = [3.0, 0.0, 0.0]\nradius = 1.0\nviscosity-ratio = 1.0\nnodes = 110\n{}"
          "[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n"
          "[topology]\nbreakup-radius = 0\ncoalescence = \"off\"\n"
          "[time]\ntolerance = {}\nend = 2.0\n",
          satellite, tolerance),
      "satellite.toml");
}

struct Outcome {
  double least_step = 1e300;  ///< after the steps in which the run gets under way
  std::optional<Vec3> place;  ///< of the satellite at the end, to t = 2 by its velocity
  double volume_ratio = 1.0;
};

Outcome run_to_the_end(const Case& c) {
  Outcome outcome;
  const Report report = run(
      c, build_scene(c), [](EvolutionOptions&) {},
      [&](const Evolution& evolution) {
        if (evolution.t() > 1.0)
          outcome.least_step = std::min(outcome.least_step, evolution.state().dt);
        const std::vector<Interface>& interfaces = evolution.scene().interfaces;
        if (interfaces.size() < 3) return;
        const Vec3 now = enclosed_centroid(interfaces[2].mesh);
        outcome.place = now + (2.0 - evolution.t()) * Vec3(now.y(), 0.0, 0.0);
        outcome.volume_ratio =
            enclosed_volume(interfaces[2].mesh) / (4.0 / 3.0 * M_PI * std::pow(0.012, 3));
      });
  EXPECT_TRUE(report.ok()) << report.text();
  return outcome;
}

// A satellite follows the liquid around it and relaxes at once. Only its path takes time steps.
TEST(Satellite, LeavesStepsLongAndKeepsItsPath) {
  const Outcome alone = run_to_the_end(parents(false, kDefaultTolerance)),
                with = run_to_the_end(parents(true, kDefaultTolerance)),
                finer = run_to_the_end(parents(true, 0.25 * kDefaultTolerance));
  EXPECT_GT(with.least_step, 0.1 * alone.least_step) << with.least_step << ' ' << alone.least_step;
  ASSERT_TRUE(with.place && finer.place);
  const double way = (*finer.place - Vec3(0.0, 0.5, 0.0)).norm();
  EXPECT_LT((*with.place - *finer.place).norm(), 0.01 * way);
  EXPECT_NEAR(with.volume_ratio, finer.volume_ratio, 0.01);
  RecordProperty("steps", fmt::format("{:.3g} of {:.3g}, path {:.2g}", with.least_step,
                                      alone.least_step, (*with.place - *finer.place).norm() / way));
}

}  // namespace
}  // namespace meniscus::test
