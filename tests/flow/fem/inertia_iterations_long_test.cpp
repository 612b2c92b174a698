#include <algorithm>
#include <iostream>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/flow/fem/stage_from_rest.hpp"

namespace meniscus::fem {
namespace {

/// The bounds on iterations over s = μτ/(ρh²) of the matrix.
void expect_few_iterations(DropShape shape, const SphereScene& drop,
                           const std::vector<double>& ratios) {
  StageFromRest stage(drop, shape, Elements::p2_p1);
  for (const double lambda : ratios)
    for (const double rho : ratios) {
      std::string row = fmt::format(
          "{} nodes, λ = {:g}, ρ̂ = {:g}:", stage.space().velocity.num_nodes, lambda, rho);
      const bool is_moderate = std::min(lambda, rho) > 5e-3 && std::max(lambda, rho) < 200.0;
      for (const double s : {1e-3, 1e-1, 1e1, 1e3, std::numeric_limits<double>::infinity()}) {
        const StokesReport report = stage.solve({lambda, 1.0, rho}, stage.duration_of(s, 1.0));
        ASSERT_TRUE(report.ok()) << row << report.text();
        row += fmt::format(" {}", report.iterations);
        EXPECT_LE(report.iterations, is_moderate ? 45 : 80) << row;
      }
      std::cout << row << std::endl;
    }
}

TEST(InertiaLong, IterationsHardlyDependOnRatiosStagesAndMeshes) {
  expect_few_iterations(DropShape::sphere, pushed_drop(110), {1e-3, 1e-2, 1.0, 1e2, 1e3});
  expect_few_iterations(DropShape::sphere, pushed_drop(800), {1e-2, 1.0, 1e2});
  expect_few_iterations(DropShape::dumbbell, extended_drop(110), {1e-3, 1e-2, 1.0, 1e2, 1e3});
  expect_few_iterations(DropShape::dumbbell, pushed_drop(110), {1e-3, 1e-2, 1.0, 1e2, 1e3});
}

}  // namespace
}  // namespace meniscus::fem
