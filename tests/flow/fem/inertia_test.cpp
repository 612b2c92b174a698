#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/fem/stage_from_rest.hpp"
#include "tests/flow/meshed_flow.hpp"

namespace meniscus::fem {
namespace {

using test::MeshedFlow;

/// A drop without tension of the matrix's liquid, in a sphere whose wall moves with a flow.
Scene one_liquid(const Mat3& gradient, const Vec3& wind, double density) {
  Scene scene = sphere_in_sphere(
      {.num_vertices = 40,
       .outer_radius = 3.0,
       .Ca = std::numeric_limits<double>::infinity(),
       .outer_per_inner = 2.0,
       .outer_velocity = [=](const Vec3& x, double) { return Vec3(gradient * x + wind); }});
  for (Liquid& liquid : scene.liquids) {
    liquid.density = density;
  }
  return scene;
}

std::vector<Vec3> at(const std::vector<Vec3>& x, const Mat3& gradient, const Vec3& wind) {
  std::vector<Vec3> v;
  for (const Vec3& each : x) v.push_back(gradient * each + wind);
  return v;
}

/// How far a stage takes v = D·x + wind from itself, after the nodes went random ways.
double error_of_stage(Elements elements, const Mat3& gradient, const Vec3& wind, double rtol) {
  const Scene scene = one_liquid(gradient, wind, 5.0);
  Options options;
  options.elements = elements;
  options.rtol = rtol;
  MeshedFlow flow(options);
  flow.follow(scene);
  const FlowSolution first = flow.solve(scene);
  EXPECT_TRUE(first.ok()) << first.text();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  ImplicitStage stage{
      .duration = 0.1, .x = first.nodal->x, .v = {}, .expected_v = {}, .slowing = {}};
  for (Vec3& x : stage.x) x += Vec3(uniform(random), uniform(random), uniform(random));
  stage.v = at(stage.x, gradient, wind);
  stage.expected_v.assign(stage.x.size(), Vec3::Zero());
  FlowDomain domain = flow.domain(scene);
  domain.stage = &stage;
  const FlowSolution next = flow.solver->solve(domain, {.t = 0.1, .dt = 0.1, .stage = Stage::end});
  EXPECT_TRUE(next.ok()) << next.text();
  const std::vector<Vec3> exact = at(next.nodal->x, gradient, wind);
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    largest = std::max(largest, (next.nodal->v[i] - exact[i]).norm());
  return largest;
}

// Geometric conservation: a uniform flow stays whatever the mesh does.
TEST(Inertia, KeepsAUniformFlowUnderAnyMotionOfTheMesh) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1})
    EXPECT_LT(error_of_stage(elements, Mat3::Zero(), Vec3(0.3, -0.2, 0.5), 1e-9), 1e-10);
}

// v = D·x with D² = 0 has no pressure.
TEST(Inertia, KeepsASimpleShearUnderAnyMotionOfTheMesh) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1})
    EXPECT_LT(error_of_stage(elements, ImposedFlow::simple_shear(), Vec3::Zero(), 1e-12), 1e-10);
}

// The preconditioner holds from short stages, which mass rules, to long ones, which viscosity does.
class InertiaByElements : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, InertiaByElements,
                         testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST_P(InertiaByElements, NeedsFewIterationsForAnyStage) {
  StageFromRest stage({.num_vertices = 110, .outer_radius = 4.0, .drop_force = {0.0, 1e-4, 0.0}},
                      DropShape::sphere, GetParam());
  for (const double density : {1e-3, 1.0, 1e3})
    for (const double duration : {1e-3, 1.0, 1e3}) {
      const StokesReport report = stage.solve({0.1, density, 0.1}, duration);
      ASSERT_TRUE(report.ok()) << report.text() << density << ", " << duration;
      EXPECT_LE(report.iterations, 45) << density << ", " << duration;
    }
}

}  // namespace
}  // namespace meniscus::fem
