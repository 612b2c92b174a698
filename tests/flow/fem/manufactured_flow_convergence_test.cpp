#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/as_quadratic.hpp"
#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

constexpr double lambda = 5.0;
double viscosity(RegionId region) { return region == RegionId{1} ? lambda : 1.0; }

// v = (cos x sin y + sin z, cos z − sin x cos y, cos(x + y)): smooth, free of divergence, the same
// in both liquids. The pressures differ, and so do the viscosities: the body force −∇·T and the
// traction jump make it a solution.
Vec3 velocity(const Vec3& x) {
  return {std::cos(x[0]) * std::sin(x[1]) + std::sin(x[2]),
          std::cos(x[2]) - std::sin(x[0]) * std::cos(x[1]), std::cos(x[0] + x[1])};
}
Mat3 velocity_gradient(const Vec3& x) {
  Mat3 gradient;
  const double s = std::sin(x[0] + x[1]);
  gradient << -std::sin(x[0]) * std::sin(x[1]), std::cos(x[0]) * std::cos(x[1]), std::cos(x[2]),
      -std::cos(x[0]) * std::cos(x[1]), std::sin(x[0]) * std::sin(x[1]), -std::sin(x[2]), -s, -s,
      0.0;
  return gradient;
}
Vec3 velocity_laplacian(const Vec3& x) {
  return {-2.0 * std::cos(x[0]) * std::sin(x[1]) - std::sin(x[2]),
          2.0 * std::sin(x[0]) * std::cos(x[1]) - std::cos(x[2]), -2.0 * std::cos(x[0] + x[1])};
}
double pressure(const Vec3& x, RegionId region) {
  return region == RegionId{1} ? 3.0 + std::exp(x[0]) * x[2] : std::sin(x[0] + 2.0 * x[1]);
}
Vec3 pressure_gradient(const Vec3& x, RegionId region) {
  if (region == RegionId{1}) return {std::exp(x[0]) * x[2], 0.0, std::exp(x[0])};
  const double c = std::cos(x[0] + 2.0 * x[1]);
  return {c, 2.0 * c, 0.0};
}
Mat3 stress(const Vec3& x, RegionId region) {
  const Mat3 gradient = velocity_gradient(x);
  return viscosity(region) * (gradient + gradient.transpose()) -
         pressure(x, region) * Mat3::Identity();
}

struct Errors {
  double h = 0.0;                                         // cube root of the mean cell volume
  double velocity = 0.0, gradient = 0.0, pressure = 0.0;  // L2 norms; pressure without its mean
};

/// Squares of the errors over all cells, by a rule that is finer than the elements' own.
template <class Element>
Errors squared_errors(const StokesProblem& problem, const StokesState& state, Element& element) {
  Errors squared;
  double volume = 0.0, pressure_sum = 0.0;
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto nodes = problem.space.velocity.of(c);
    const auto pressures = problem.space.pressure.nodes.of(c);
    const RegionId region = problem.mesh.region[c];
    for (const auto& point : element.points(c)) {
      Vec3 x = Vec3::Zero(), v = Vec3::Zero();
      Mat3 gradient = Mat3::Zero();
      double p = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec3& at_node = state.v[NodeId{nodes[i]}];
        x += point.value[i] * problem.positions.x[NodeId{nodes[i]}];
        v += point.value[i] * at_node;
        gradient += at_node * point.gradient.col(static_cast<Eigen::Index>(i)).transpose();
      }
      for (std::size_t k = 0; k < 4; ++k)
        p += point.pressure[k] * state.p[static_cast<std::size_t>(pressures[k])];
      const double p_error = p - pressure(x, region);
      squared.velocity += point.weight * (v - velocity(x)).squaredNorm();
      squared.gradient += point.weight * (gradient - velocity_gradient(x)).squaredNorm();
      squared.pressure += point.weight * p_error * p_error;
      pressure_sum += point.weight * p_error;
      volume += point.weight;
    }
  }
  squared.pressure -= pressure_sum * pressure_sum / volume;
  squared.h = std::cbrt(volume / problem.mesh.num_cells());
  return squared;
}

Errors errors(const StokesProblem& problem, const StokesState& state) {
  if (problem.space.elements == Elements::p1_p1) {
    const AsQuadratic quadratic(problem, state);
    return errors(quadratic.problem, quadratic.state);
  }
  const NodePositions positions = all_curved(problem.positions);
  QuadraticElement element(problem.space, positions);
  const Errors squared = squared_errors(problem, state, element);
  return {squared.h, std::sqrt(squared.velocity), std::sqrt(squared.gradient),
          std::sqrt(squared.pressure)};
}

Vec3 force(const Vec3& x, RegionId region) {
  return pressure_gradient(x, region) - viscosity(region) * velocity_laplacian(x);
}

/// The body force: its mean per cell for P1, whose stabilisation wants it; at the points of the
/// finer rule for P2.
void add_body_force(StokesProblem& problem) {
  const NodePositions positions = all_curved(problem.positions);
  QuadraticElement element(problem.space, positions);  // asked for points of P2 alone
  for (const CellId c : problem.mesh.cells.ids()) {
    const RegionId region = problem.mesh.region[c];
    if (problem.space.elements == Elements::p1_p1) {
      Vec3 centroid = Vec3::Zero();
      for (const TetVertexId v : problem.mesh.cells[c]) centroid += 0.25 * problem.mesh.x[v];
      problem.body_force[c] = force(centroid, region);
      continue;
    }
    const auto nodes = problem.space.velocity.of(c);
    for (const auto& point : element.points(c)) {
      Vec3 x = Vec3::Zero();
      for (std::size_t i = 0; i < nodes.size(); ++i)
        x += point.value[i] * positions.x[NodeId{nodes[i]}];
      for (std::size_t i = 0; i < nodes.size(); ++i)
        problem.force[NodeId{nodes[i]}] += point.weight * point.value[i] * force(x, region);
    }
  }
}

Errors solve(const TestSpace& test, const OuterBoundary& boundary) {
  StokesProblem problem = test.problem();
  BoundaryConditions conditions = test.conditions(boundary);
  EXPECT_EQ(text_of(conditions.fault), "");
  problem.constraints = conditions.constraints;
  for (const CellId c : test.mesh.cells.ids())
    problem.viscosity[c] = viscosity(test.mesh.region[c]);
  add_body_force(problem);
  add_traction_jump(
      [](const Vec3& x, const Vec3& n) {
        return Vec3((stress(x, RegionId{0}) - stress(x, RegionId{1})) * n);
      },
      problem);
  Options options;
  options.elements = test.space.elements;
  options.rtol = 1e-10;
  StokesSolver solver(test.space, options);
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
  EXPECT_TRUE(report.ok()) << report.text();
  EXPECT_EQ(report.solver, LinearSolver::block);
  return errors(problem, state);
}

/// Orders of velocity (L2) and its gradient: 2 and 1, or 3 and 2; the pressure's at least 1, or 2.
void expect_orders(const std::vector<Errors>& levels, Elements elements) {
  const double degree = elements == Elements::p1_p1 ? 1.0 : 2.0;
  const double span = std::log(levels.front().h / levels.back().h);
  const auto order = [&](double first, double last) { return std::log(first / last) / span; };
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LT(levels[i].velocity, levels[i - 1].velocity);
    EXPECT_LT(levels[i].pressure, levels[i - 1].pressure);
  }
  EXPECT_NEAR(order(levels.front().velocity, levels.back().velocity), degree + 1.0, 0.2);
  EXPECT_NEAR(order(levels.front().gradient, levels.back().gradient), degree, 0.2);
  EXPECT_GT(order(levels.front().pressure, levels.back().pressure), degree - 0.1);
}

class ManufacturedFlow : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, ManufacturedFlow,
                         testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST_P(ManufacturedFlow, ConvergesAcrossAPlane) {
  std::vector<Errors> levels;
  const bool is_quadratic = GetParam() == Elements::p2_p1;
  for (const int n : is_quadratic ? std::vector{4, 6, 10} : std::vector{6, 10, 18}) {
    BoxMesh box = box_mesh(
        {.n = n, .region = [](const Vec3& x) { return x.z() < 0.0 ? 1 : 0; }, .jitter = 0.15});
    impose_everywhere(box.boundary, velocity, false);
    levels.push_back(solve(TestSpace(box.mesh, GetParam()), box.boundary));
  }
  expect_orders(levels, GetParam());
}

TEST_P(ManufacturedFlow, ConvergesAroundASphere) {
  std::vector<Errors> levels;
  for (const int num_vertices : {200, 400, 800}) {
    const Scene scene =
        sphere_in_sphere({.num_vertices = num_vertices,
                          .outer_radius = 2.0,
                          .outer_per_inner = 1.25,
                          .outer_velocity = [](const Vec3& x, double) { return velocity(x); }});
    TetMesh mesh;
    ASSERT_TRUE(tetrahedralize(scene, {}, mesh).ok());
    levels.push_back(solve(TestSpace(scene, mesh, GetParam()), scene.boundary));
  }
  expect_orders(levels, GetParam());
}

}  // namespace
}  // namespace meniscus::fem
