#include "meniscus/flow/fem/stokes_solver.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/flow/fem/sheared_drop.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

StokesReport solve(const StokesProblem& problem, StokesSolver& solver, StokesState& state) {
  PhaseTimes times;
  return solver.solve(problem, state, linear::Preconditioner::fresh, times);
}

class EitherElement : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, EitherElement, testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST_P(EitherElement, AllLinearSolversAgree) {
  const ShearedDrop drop(GetParam());
  const StokesProblem problem = drop.problem();
  std::vector<StokesState> states;
  for (const LinearSolver which : {LinearSolver::mumps, LinearSolver::block, LinearSolver::minres,
                                   LinearSolver::paper_gmres}) {
    if (which == LinearSolver::paper_gmres && GetParam() == Elements::p2_p1) continue;
    Options options;
    options.linear = which;
    options.rtol = 1e-10;
    StokesSolver solver(drop.space, with(drop.space.elements, options));
    StokesState state = solver.state_at_rest();
    const StokesReport report = solve(problem, solver, state);
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_EQ(report.solver, which);
    EXPECT_LT(report.residual, 2.1e-10 * report.reference);
    states.push_back(std::move(state));
  }
  for (const StokesState& state : states) {
    // The residual's tolerance over the smallest nodal masses (1e-4: small cells), relative to
    // velocities near 4 and pressures near 7.
    for (const NodeId v : state.v.ids()) EXPECT_LT((state.v[v] - states[0].v[v]).norm(), 4e-6);
    for (std::size_t i = 0; i < state.p.size(); ++i) EXPECT_NEAR(state.p[i], states[0].p[i], 7e-6);
  }
}

// The Krylov method's own residuals are those that the solver judges by, weighted or not.
TEST_P(EitherElement, TheKrylovMethodMeasuresAsTheSolverDoes) {
  const ShearedDrop drop(GetParam());
  const StokesProblem problem = drop.problem();
  EXPECT_EQ(residual_weights(problem).empty(), GetParam() == Elements::p1_p1);
  StokesSolver solver(drop.space, with(drop.space.elements, {}));
  StokesState state = solver.state_at_rest();
  const StokesReport report = solve(problem, solver, state);
  ASSERT_TRUE(report.ok()) << report.text();
  EXPECT_EQ(report.solver, LinearSolver::block);
  EXPECT_EQ(report.newton_steps, 1);
  EXPECT_NEAR(report.linear_residuals.back(), report.residual, 0.01 * report.residual);
}

// reaction + body force + loads = dissipation, exactly but for the solver's residual; and the
// capillary load's power is minus the growth of the surface energy.
TEST_P(EitherElement, EnergyIsBalancedToTheSolversTolerance) {
  const ShearedDrop drop(GetParam());
  const StokesProblem problem = drop.problem();
  Options options;
  options.rtol = 1e-11;
  StokesSolver solver(drop.space, with(drop.space.elements, options));
  StokesState state = solver.state_at_rest();
  ASSERT_TRUE(solve(problem, solver, state).ok());
  const StokesPower books = power(problem, state);
  EXPECT_GT(books.dissipation, 1.0);
  EXPECT_GT(std::abs(books.body_force), 1e-3);
  EXPECT_GT(std::abs(books.force), 1e-2);
  EXPECT_NEAR(books.reaction + books.body_force + books.force, books.dissipation,
              1e-8 * books.dissipation);
  if (GetParam() != Elements::p1_p1) return;
  const VertexField<Vec3> gradient = area_gradient(drop.scene.interfaces[0].mesh);
  double growth = 0.0;
  for (const VertexId v : gradient.ids())
    growth += gradient[v].dot(state.v[node_at(drop.mesh.interfaces[0].vertex(v))]);
  EXPECT_NEAR(books.force, -growth / 0.3, 1e-10 * std::abs(books.force));
}

// Each region's volume is kept: the discrete flux through the drop's surface is zero.
TEST_P(EitherElement, NoNetFluxThroughTheInterface) {
  const ShearedDrop drop(GetParam());
  Options options;
  options.rtol = 1e-11;
  StokesSolver solver(drop.space, with(drop.space.elements, options));
  StokesState state = solver.state_at_rest();
  const StokesProblem problem = drop.problem();
  ASSERT_TRUE(solve(problem, solver, state).ok());
  const Field<NodeId, Vec3> area = node_area_vectors(drop.drop_faces(), problem.positions.x);
  double flux = 0.0;
  for (const NodeId i : area.ids()) flux += area[i].dot(state.v[i]);
  EXPECT_NEAR(flux, 0.0, 1e-9);
}

// Solutions turn with the problem: rotated frames at slip walls included.
TEST(StokesSolver, SolutionsTurnWithTheBox) {
  const Mat3 rotation = Eigen::AngleAxisd(0.9, Vec3(0.3, 1, -2).normalized()).toRotationMatrix();
  const Vec3 force(1.0, -2.0, 0.5);
  const auto solution = [&](const Mat3& turn) {
    BoxMesh box = box_mesh({.n = 4,
                            .region = [](const Vec3& x) { return x.norm() < 0.6 ? 1 : 0; },
                            .jitter = 0.1,
                            .rotation = turn});
    for (const PatchId patch : box.boundary.patches.ids())
      box.boundary.patches[patch].condition = NoPenetration{};
    const TestSpace test(box.mesh);
    StokesProblem problem = test.problem();
    for (const CellId c : box.mesh.cells.ids())
      if (box.mesh.region[c] == RegionId{1}) {
        problem.viscosity[c] = 4.0;
        problem.body_force[c] = turn * force;
      }
    problem.constraints = test.conditions(box.boundary).constraints;
    Options options;
    options.rtol = 1e-11;
    StokesSolver solver(test.space, options);
    StokesState state = solver.state_at_rest();
    const StokesReport report = solve(problem, solver, state);
    EXPECT_TRUE(report.ok()) << report.text();
    EXPECT_EQ(report.solver, LinearSolver::block);
    EXPECT_LT(report.iterations, 60);
    return state;
  };
  const StokesState straight = solution(Mat3::Identity()), turned = solution(rotation);
  double largest = 0.0;
  for (const NodeId v : straight.v.ids()) {
    EXPECT_LT((turned.v[v] - rotation * straight.v[v]).norm(), 1e-8);
    largest = std::max(largest, straight.v[v].norm());
  }
  EXPECT_GT(largest, 1e-3);
}

/// The same nodes, further out along x and nearer along z.
StokesProblem stretched(const ShearedDrop& drop, double stretch) {
  StokesProblem problem = drop.problem();
  for (Vec3& x : problem.positions.x) x = x.cwiseProduct(Vec3(stretch, 1.0, 1.0 / stretch));
  return problem;
}

// What was made for a mesh preconditions the same mesh after it has moved.
TEST_P(EitherElement, AKeptPreconditionerSolvesOnAMovedMesh) {
  const ShearedDrop drop(GetParam());
  const StokesProblem before = drop.problem(), moved = stretched(drop, 1.1);
  Options options;
  options.rtol = 1e-9;
  StokesSolver keeping(drop.space, with(GetParam(), options)),
      fresh(drop.space, with(GetParam(), options));
  StokesState kept = keeping.state_at_rest(), expected = fresh.state_at_rest();
  ASSERT_TRUE(solve(before, keeping, kept).ok());
  kept = keeping.state_at_rest();
  PhaseTimes times;
  const StokesReport report = keeping.solve(moved, kept, linear::Preconditioner::kept, times),
                     by_fresh = solve(moved, fresh, expected);
  ASSERT_TRUE(report.ok() && by_fresh.ok()) << report.text() << by_fresh.text();
  EXPECT_TRUE(report.failed_solvers.empty());
  EXPECT_LE(report.iterations, by_fresh.iterations + 6);
  for (const NodeId v : kept.v.ids()) EXPECT_LT((kept.v[v] - expected.v[v]).norm(), 4e-6);
}

TEST(StokesSolver, AFailedSolverIsReplaced) {
  const ShearedDrop drop;
  const StokesProblem problem = drop.problem();
  Options options;
  options.linear = LinearSolver::paper_gmres;
  options.max_iterations = 60;  // enough for the block solvers, far too few for the paper's
  options.rtol = 1e-6;
  StokesSolver solver(drop.space, with(drop.space.elements, options));
  StokesState state = solver.state_at_rest();
  const StokesReport report = solve(problem, solver, state);
  ASSERT_TRUE(report.ok()) << report.text();
  EXPECT_EQ(report.solver, LinearSolver::block);
  EXPECT_GT(report.iterations, 60);
  EXPECT_LT(report.residual, 2.1e-6 * report.reference);
}

// All iterations refused: small problems end with the direct solver.
TEST_P(EitherElement, TheLastResortOfSmallProblemsIsDirect) {
  const ShearedDrop drop(GetParam());
  const StokesProblem problem = drop.problem();
  Options options;
  options.max_iterations = 3;
  StokesSolver solver(drop.space, with(GetParam(), options));
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::kept, times);
  ASSERT_TRUE(report.ok()) << report.text();
  EXPECT_EQ(report.solver, LinearSolver::mumps);
  EXPECT_LT(report.residual, 2.1e-6 * report.reference);
  std::vector<std::string> expected = {"block", "block", "minres", "paper-gmres"};
  if (GetParam() == Elements::p2_p1) expected.pop_back();  // it scales by a diagonal they lack
  ASSERT_EQ(report.failed_solvers.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(report.failed_solvers[i], "linear solver " + expected[i] + ": DIVERGED_ITS");
}

// Large ones do without: a factorisation would not fit. The report has the history of the last.
TEST(StokesSolver, FailureOfAllIsReported) {
  const Scene scene = sphere_in_sphere({.num_vertices = 300});
  TetMesh mesh;
  ASSERT_TRUE(tetrahedralize(scene, {}, mesh).ok());
  const FlowSpace space = flow_space(mesh, Elements::p2_p1);
  ASSERT_GT(space.velocity.num_nodes, 20000);
  StokesProblem problem(mesh, space, node_positions(scene, mesh, space));
  for (const NodeId i : problem.force.ids()) problem.force[i] = problem.positions.x[i];
  problem.has_open_boundary = true;
  Options options;
  options.max_iterations = 2;
  StokesSolver solver(space, with(Elements::p2_p1, options));
  StokesState state = solver.state_at_rest();
  const StokesReport report = solve(problem, solver, state);
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.text(), "DIVERGED_ITS");
  EXPECT_EQ(report.solver, LinearSolver::minres);
  ASSERT_EQ(report.linear_residuals.size(), 3u);
  EXPECT_GT(report.linear_residuals[0], report.linear_residuals[2]);
  EXPECT_EQ(report.failed_solvers.size(), 1u);
  const StokesState rest = solver.state_at_rest();
  EXPECT_EQ(state.v, rest.v);
  EXPECT_EQ(state.p, rest.p);
}

TEST(StokesSolver, DataThatAreNotFiniteAreReported) {
  const ShearedDrop drop;
  StokesProblem problem = drop.problem();
  problem.force[NodeId{3}][1] = std::nan("");
  StokesSolver solver(drop.space, with(drop.space.elements));
  StokesState state = solver.state_at_rest();
  const StokesReport report = solve(problem, solver, state);
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.text().find("not finite"), std::string::npos);
}

TEST(StokesSolver, AGoodGuessSavesIterations) {
  const ShearedDrop drop;
  const StokesProblem problem = drop.problem();
  StokesSolver solver(drop.space, with(drop.space.elements));
  StokesState state = solver.state_at_rest();
  const StokesReport cold = solve(problem, solver, state);
  ASSERT_TRUE(cold.ok());
  const StokesReport again = solve(problem, solver, state);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again.iterations, 0);
  for (Vec3& v : state.v) v *= 1.001;
  const StokesReport warm = solve(problem, solver, state);
  ASSERT_TRUE(warm.ok());
  EXPECT_LT(warm.iterations, cold.iterations);
}

}  // namespace
}  // namespace meniscus::fem
