#include "meniscus/flow/fem/surface_damping.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/mesh/rigid_motion.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/flow/fem/lamb_mode.hpp"
#include "tests/flow/fem/sheared_drop.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

/// Damping of strength 1 on the drop of a scene, and where its nodes are.
struct DampedDrop {
  TetMesh mesh;
  FlowSpace space;
  NodePositions positions;
  FaceNodeTable faces;
  SurfaceDamping damping;

  DampedDrop(const Scene& scene, Elements elements, double k = 0.0) {
    EXPECT_TRUE(tetrahedralize(scene, suited_volume_mesh(elements), mesh).ok());
    space = flow_space(mesh, elements);
    positions = node_positions(scene, mesh, space);
    faces = face_nodes(space, mesh, scene.interfaces[0].mesh, mesh.interfaces[0]);
    damping = surface_damping(std::vector{DampedSurface{faces, 1.0, k}}, positions);
  }
  /// K u by node.
  [[nodiscard]] Field<NodeId, double> stiffness_times(const Field<NodeId, double>& u) const {
    Field<NodeId, double> result(u.size(), 0.0);
    for (const auto& [row, column, weight] : damping.entries) result[row] += weight * u[column];
    return result;
  }
  template <class Function>
  [[nodiscard]] Field<NodeId, double> on_nodes(Function&& u) const {
    Field<NodeId, double> result(positions.x.size(), 0.0);
    for (const NodeId i : faces.face_nodes) result[i] = u(i);
    return result;
  }
};

double dot(const Field<NodeId, double>& a, const Field<NodeId, double>& b) {
  double sum = 0.0;
  for (const NodeId i : a.ids()) sum += a[i] * b[i];
  return sum;
}

Scene ellipsoid(int num_vertices) {
  Scene scene = sphere_in_sphere({.num_vertices = num_vertices, .outer_radius = 3.0, .Ca = 1.0});
  for (Vec3& x : scene.interfaces[0].mesh.x) x = x.cwiseProduct(Vec3(1.3, 1.0, 0.8));
  return scene;
}

class SurfaceDampingBy : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, SurfaceDampingBy,
                         testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST_P(SurfaceDampingBy, IsSymmetricNeverNegativeAndBlindToAUniformSpeed) {
  const DampedDrop drop(ellipsoid(110), GetParam());
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto noise = [&](NodeId) { return normal(random); };
  for (int sample = 0; sample < 10; ++sample) {
    const Field<NodeId, double> u = drop.on_nodes(noise), w = drop.on_nodes(noise);
    const double scale = dot(u, drop.stiffness_times(u));
    EXPECT_GT(scale, 0.0);
    EXPECT_NEAR(dot(w, drop.stiffness_times(u)), dot(u, drop.stiffness_times(w)), 1e-12 * scale);
  }
  const Field<NodeId, double> of_one =
      drop.stiffness_times(drop.on_nodes([](NodeId) { return 1.0; }));
  for (const double each : of_one) EXPECT_NEAR(each, 0.0, 1e-12);
}

// A translation has the normal speed n·V of degree 1: it is resisted unless it is what damping is
// about. So is a turn.
TEST_P(SurfaceDampingBy, ResistsARigidMotionUnlessItIsAboutIt) {
  DampedDrop drop(ellipsoid(110), GetParam());
  const RigidMotion motion{.velocity = Vec3(0.3, -1.0, 0.5), .spin = Vec3(0.2, 0.4, -0.3)};
  Field<NodeId, Vec3> v(drop.positions.x.size(), Vec3::Zero());
  for (const NodeId i : v.ids()) v[i] = motion.at(drop.positions.x[i]);
  const auto resistance = [&] {
    Field<NodeId, Vec3> momentum(v.size(), Vec3::Zero());
    add_resistance(drop.damping, v, momentum);
    double power = 0.0, largest = 0.0;
    for (const NodeId i : v.ids()) {
      power += momentum[i].dot(v[i]);
      largest = std::max(largest, momentum[i].norm());
    }
    return std::pair(power, largest);
  };
  // 2∫(n·V)² dS = 8π/3 V² on the unit sphere.
  EXPECT_GT(resistance().first, 8.0);
  drop.damping.speed = normal_speeds(drop.damping, v);
  EXPECT_EQ(resistance().second, 0.0);
}

// ∫(|∇_s P_l|² + k P_l²) dS = (l(l + 1) + k) 4π/(2l + 1) on the unit sphere.
double energy_error(int num_vertices, Elements elements, int l, double k) {
  const DampedDrop drop(
      sphere_in_sphere({.num_vertices = num_vertices, .outer_radius = 3.0, .Ca = 1.0}), elements,
      k);
  const Field<NodeId, double> u = drop.on_nodes(
      [&](NodeId i) { return legendre(l, drop.positions.x[i].normalized().x()).value; });
  const double exact = (l * (l + 1) + k) * 4.0 * std::numbers::pi / (2 * l + 1);
  for (const NodeId i : drop.faces.face_nodes)
    EXPECT_NEAR(drop.damping.normal[i].dot(drop.positions.x[i].normalized()), 1.0, 0.01);
  return std::abs(dot(u, drop.stiffness_times(u)) / exact - 1.0);
}

// Of second order in h on flat faces, of fourth on quadratic ones; h² ~ 1/N.
TEST_P(SurfaceDampingBy, ConvergesToTheVariationOfAreaOnASphere) {
  for (const auto& [l, k] : {std::pair(2, 0.0), std::pair(4, 0.0), std::pair(2, 5.0)}) {
    const double coarse = energy_error(200, GetParam(), l, k),
                 fine = energy_error(800, GetParam(), l, k);
    std::printf("l = %d, k = %g: %.2e %.2e\n", l, k, coarse, fine);
    EXPECT_LT(fine, GetParam() == Elements::p1_p1 ? 0.05 : 0.005);
    EXPECT_GT(std::log2(coarse / fine), GetParam() == Elements::p1_p1 ? 1.8 : 3.8);
  }
}

/// A sheared drop whose damping has the strength τσ/(μl) of the mean edge, μ that of the matrix.
StokesProblem damped_problem(const ShearedDrop& drop, double strength) {
  StokesProblem problem = drop.problem();
  const double edge = mean_edge(drop.scene.interfaces[0].mesh);
  const FaceNodeTable faces = drop.drop_faces();
  problem.damping =
      surface_damping(std::vector{DampedSurface{faces, strength * edge}}, problem.positions);
  for (const NodeId i : faces.face_nodes)
    problem.damping.speed[i] = 0.1 * problem.positions.x[i].x();
  return problem;
}

// One Newton step solves the damped problem: the matrix is the derivative of the residual, which is
// made without it. The preconditioner knows damping too.
TEST_P(SurfaceDampingBy, IsSolvedInFewIterations) {
  const ShearedDrop drop(GetParam());
  for (const double strength : {0.0, 0.1, 1.0, 3.0, 10.0, 30.0}) {
    const StokesProblem problem = strength > 0.0 ? damped_problem(drop, strength) : drop.problem();
    Options options;
    options.elements = GetParam();
    StokesSolver solver(drop.space, options);
    StokesState state = solver.state_at_rest();
    PhaseTimes times;
    const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
    ASSERT_TRUE(report.ok()) << report.text();
    std::printf("strength %g: %d\n", strength, report.iterations);
    EXPECT_EQ(report.newton_steps, 1);
    EXPECT_LT(report.iterations, 60);
  }
}

}  // namespace
}  // namespace meniscus::fem
