#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/meshed_flow.hpp"

namespace meniscus::fem {
namespace {

using test::MeshedFlow;

/// Iterations of a stage of length τ = s ρh²/μ of the matrix, h the mean edge of the interface,
/// with a fresh preconditioner, from rest. Forces are so small that nothing convects.
int iterations(int num_vertices, double viscosity_ratio, double density_ratio, double s) {
  Scene scene = sphere_in_sphere({.num_vertices = num_vertices,
                                  .outer_radius = 4.0,
                                  .viscosity_ratio = viscosity_ratio,
                                  .Ca = 1e8,
                                  .drop_force = Vec3(0.0, 1e-8, 0.0)});
  scene.liquids[RegionId{0}].density = 1.0;
  scene.liquids[RegionId{1}].density = density_ratio;
  Options options;
  options.elements = Elements::p2_p1;
  MeshedFlow flow(options);
  flow.follow(scene);
  const FlowSolution first = flow.solve(scene);
  EXPECT_TRUE(first.ok()) << first.text();
  const std::vector<Vec3> rest(first.nodal->x.size(), Vec3::Zero());
  const double edge = std::sqrt(4.0 * std::numbers::pi / num_vertices * 2.0 / std::sqrt(3.0));
  const ImplicitStage stage{s * edge * edge, first.nodal->x, rest, rest, {}};
  FlowDomain domain = flow.domain(scene);
  domain.stage = &stage;
  const FlowSolution next = flow.solver->solve(domain, {.dt = stage.duration});
  EXPECT_TRUE(next.ok()) << next.text();
  return next.iterations;
}

TEST(InertiaLong, IterationsHardlyDependOnRatiosStagesAndMeshes) {
  const auto table = [](int num_vertices, const std::vector<double>& ratios) {
    for (const double lambda : ratios)
      for (const double rho : ratios) {
        std::string row = fmt::format("N0 = {}, λ = {:g}, ρ̂ = {:g}:", num_vertices, lambda, rho);
        const bool is_moderate = std::min(lambda, rho) > 5e-3 && std::max(lambda, rho) < 200.0;
        for (const double s : {1e-3, 1e-1, 1e1, 1e3}) {
          const int count = iterations(num_vertices, lambda, rho, s);
          row += fmt::format(" {}", count);
          EXPECT_LE(count, is_moderate ? 45 : 80) << row;
        }
        std::cout << row << std::endl;
      }
  };
  table(110, {1e-3, 1e-2, 1.0, 1e2, 1e3});
  table(1000, {1e-2, 1.0, 1e2});
}

}  // namespace
}  // namespace meniscus::fem
