#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/linear_tetrahedron.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/box_mesh.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

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

Errors errors(const TetMesh& mesh, const PressureSpace& space, const StokesState& state) {
  Errors squared;
  double volume = 0.0, pressure_sum = 0.0;
  // Four points of the rule of degree 2.
  const double a = 0.1381966011250105, b = 1.0 - 3.0 * a;
  for (const CellId c : mesh.cells.ids()) {
    const LinearTetrahedron tet = linear_tetrahedron(mesh, c);
    const CellVertices& vertices = mesh.cells[c];
    const auto nodes = space.nodes.of(c);
    Mat3 gradient = Mat3::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      gradient += state.v[vertices[i]] * tet.gradient[i].transpose();
    for (std::size_t q = 0; q < 4; ++q) {
      Vec3 x = Vec3::Zero(), v = Vec3::Zero();
      double p = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double phi = i == q ? b : a;
        x += phi * mesh.x[vertices[i]];
        v += phi * state.v[vertices[i]];
        p += phi * state.p[static_cast<std::size_t>(nodes[i])];
      }
      const double weight = 0.25 * tet.volume, p_error = p - pressure(x, mesh.region[c]);
      squared.velocity += weight * (v - velocity(x)).squaredNorm();
      squared.gradient += weight * (gradient - velocity_gradient(x)).squaredNorm();
      squared.pressure += weight * p_error * p_error;
      pressure_sum += weight * p_error;
      volume += weight;
    }
  }
  squared.pressure -= pressure_sum * pressure_sum / volume;
  return {std::cbrt(volume / mesh.num_cells()), std::sqrt(squared.velocity),
          std::sqrt(squared.gradient), std::sqrt(squared.pressure)};
}

Errors solve(const TetMesh& mesh, const OuterBoundary& boundary) {
  StokesProblem problem(mesh);
  BoundaryConditions conditions = boundary_conditions(boundary, mesh, 0.0);
  EXPECT_EQ(conditions.failure, "");
  problem.constraints = conditions.constraints;
  for (const CellId c : mesh.cells.ids()) {
    Vec3 centroid = Vec3::Zero();
    for (const TetVertexId v : mesh.cells[c]) centroid += 0.25 * mesh.x[v];
    const RegionId region = mesh.region[c];
    problem.viscosity[c] = viscosity(region);
    problem.body_force[c] =
        pressure_gradient(centroid, region) - viscosity(region) * velocity_laplacian(centroid);
  }
  add_traction_jump(
      mesh,
      [](const Vec3& x, const Vec3& n) {
        return Vec3((stress(x, RegionId{0}) - stress(x, RegionId{1})) * n);
      },
      problem.load);
  Options options;
  options.rtol = 1e-10;
  StokesSolver solver(mesh, options);
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
  EXPECT_TRUE(report.ok) << report.failure;
  EXPECT_EQ(report.solver, LinearSolver::block);
  return errors(mesh, solver.pressure_space(), state);
}

void expect_orders(const std::vector<Errors>& levels) {
  const double span = std::log(levels.front().h / levels.back().h);
  const auto order = [&](double first, double last) { return std::log(first / last) / span; };
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LT(levels[i].velocity, levels[i - 1].velocity);
    EXPECT_LT(levels[i].pressure, levels[i - 1].pressure);
  }
  EXPECT_NEAR(order(levels.front().velocity, levels.back().velocity), 2.0, 0.2);
  EXPECT_NEAR(order(levels.front().gradient, levels.back().gradient), 1.0, 0.2);
  EXPECT_GT(order(levels.front().pressure, levels.back().pressure), 1.0);
}

TEST(ManufacturedFlow, ConvergesAcrossAPlane) {
  std::vector<Errors> levels;
  for (const int n : {6, 10, 18}) {
    BoxMesh box = box_mesh(
        {.n = n, .region = [](const Vec3& x) { return x.z() < 0.0 ? 1 : 0; }, .jitter = 0.15});
    impose_everywhere(box.boundary, velocity, false);
    levels.push_back(solve(box.mesh, box.boundary));
  }
  expect_orders(levels);
}

TEST(ManufacturedFlow, ConvergesAroundASphere) {
  std::vector<Errors> levels;
  for (const int num_vertices : {200, 400, 800}) {
    const Scene scene =
        sphere_in_sphere({.num_vertices = num_vertices,
                          .outer_radius = 2.0,
                          .outer_per_inner = 1.25,
                          .outer_velocity = [](const Vec3& x, double) { return velocity(x); }});
    TetMesh mesh;
    ASSERT_TRUE(tetrahedralize(scene, {}, mesh).ok);
    levels.push_back(solve(mesh, scene.boundary));
  }
  expect_orders(levels);
}

}  // namespace
}  // namespace meniscus::fem
