// Newton's method on generalised-Newtonian liquids: its answers, its steps, its books.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

const CarreauYasuda thinning{
    .time_constant = 4.0, .power_index = 0.3, .yasuda_exponent = 2.0, .infinite_ratio = 0.01};

/// A block that sinks through a sheared box: its own liquid and that around it have laws.
struct SinkingBlock {
  BoxMesh box;
  TestSpace test;
  StokesProblem problem;

  SinkingBlock(Elements elements, const ViscosityLaw& around, const ViscosityLaw& within, int n = 6)
      : box(box_mesh({.n = n,
                      .region = [](const Vec3& x) { return x.cwiseAbs().maxCoeff() < 0.6 ? 1 : 0; },
                      .jitter = 0.1})),
        test(box.mesh, elements),
        problem(test.problem()) {
    for (const PatchId patch : box.boundary.patches.ids())
      box.boundary.patches[patch].condition = NoPenetration{};
    for (const std::int32_t side : {2, 3})
      box.boundary.patches[PatchId{side}].condition =
          ImposedVelocity{[](const Vec3& x, double) { return Vec3(x.y(), 0.0, 0.0); }, false};
    problem.constraints = test.conditions(box.boundary).constraints;
    for (const CellId c : box.mesh.cells.ids())
      if (box.mesh.region[c] == RegionId{1}) {
        problem.viscosity[c] = 3.0;
        problem.body_force[c] = Vec3(0.5, -4.0, 1.0);
      }
    problem.laws.add(around);
    problem.laws.add(within);
  }
};

struct Solution {
  StokesState state;
  StokesReport report;
};

Options options_with(double rtol, LinearSolver which = LinearSolver::block) {
  Options options;
  options.rtol = rtol;
  options.linear = which;
  return options;
}

Solution solve(const SinkingBlock& block, double rtol, LinearSolver which = LinearSolver::block) {
  const Options options = with(block.test.space.elements, options_with(rtol, which));
  StokesSolver solver(block.test.space, options);
  Solution solution{solver.state_at_rest(), {}};
  PhaseTimes times;
  solution.report =
      solver.solve(block.problem, solution.state, linear::Preconditioner::fresh, times);
  return solution;
}

double largest_difference(const StokesState& a, const StokesState& b) {
  double largest = 0.0;
  for (const NodeId i : a.v.ids()) largest = std::max(largest, (a.v[i] - b.v[i]).norm());
  return largest;
}

class GeneralisedSolver : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, GeneralisedSolver,
                         testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST_P(GeneralisedSolver, AllLinearSolversGiveOneAnswer) {
  const SinkingBlock block(GetParam(), thinning, PowerLaw{.power_index = 0.5},
                           GetParam() == Elements::p1_p1 ? 6 : 4);
  std::vector<StokesState> states;
  for (const LinearSolver which : {LinearSolver::mumps, LinearSolver::block, LinearSolver::minres,
                                   LinearSolver::paper_gmres}) {
    if (which == LinearSolver::paper_gmres && GetParam() == Elements::p2_p1) continue;
    const Solution solution = solve(block, 1e-10, which);
    ASSERT_TRUE(solution.report.ok()) << solution.report.text();
    EXPECT_EQ(solution.report.solver, which);
    EXPECT_TRUE(solution.report.failed_solvers.empty());
    states.push_back(solution.state);
  }
  // The residual's tolerance over the smallest stiffnesses, those of the thinned liquid: 1e-2 of
  // the others'; velocities are near 1.
  for (const StokesState& state : states) EXPECT_LT(largest_difference(state, states[0]), 1e-6);
}

// n = 1 is Newton's law whatever the other numbers are.
TEST_P(GeneralisedSolver, ALawWithoutThinningIsNewtons) {
  const SinkingBlock with_law(GetParam(), CarreauYasuda{.time_constant = 3.0, .power_index = 1.0},
                              PowerLaw{.power_index = 1.0});
  SinkingBlock newtonian(GetParam(), Newtonian{}, Newtonian{});
  EXPECT_FALSE(newtonian.problem.is_generalised());
  const Solution a = solve(with_law, 1e-10), b = solve(newtonian, 1e-10);
  ASSERT_TRUE(a.report.ok() && b.report.ok());
  EXPECT_LE(a.report.newton_steps + a.report.picard_steps, 3);  // solved to 1e-2 at first
  EXPECT_LT(largest_difference(a.state, b.state), 1e-8);
}

TEST_P(GeneralisedSolver, AGoodGuessSavesSteps) {
  const SinkingBlock block(GetParam(), thinning, thinning);
  const Options options = with(GetParam(), options_with(1e-8));
  StokesSolver solver(block.test.space, options);
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  const auto again = [&] {
    return solver.solve(block.problem, state, linear::Preconditioner::fresh, times);
  };
  const StokesReport cold = again();
  ASSERT_TRUE(cold.ok()) << cold.text();
  EXPECT_GT(cold.picard_steps, 0);
  EXPECT_EQ(cold.residuals.size(),
            static_cast<std::size_t>(cold.newton_steps + cold.picard_steps + 1));
  EXPECT_EQ(again().iterations, 0);
  for (Vec3& v : state.v) v *= 1.01;
  const StokesReport warm = again();
  ASSERT_TRUE(warm.ok()) << warm.text();
  EXPECT_EQ(warm.picard_steps, 0);
  EXPECT_LT(warm.newton_steps, cold.newton_steps + cold.picard_steps);
}

// reaction + body force = dissipation with the viscosity that each point has.
TEST_P(GeneralisedSolver, EnergyIsBalancedWithTheTrueViscosity) {
  const SinkingBlock block(GetParam(), thinning, PowerLaw{.power_index = 1.5});
  const Solution solution = solve(block, 1e-11);
  ASSERT_TRUE(solution.report.ok()) << solution.report.text();
  const StokesPower books = power(block.problem, solution.state);
  EXPECT_GT(books.body_force, 0.01);
  EXPECT_GT(books.reaction, 0.01);
  EXPECT_NEAR(books.reaction + books.body_force, books.dissipation, 1e-8 * books.dissipation);
}

// Strong thinning over six decades of viscosity, and thickening: from rest to the end.
TEST_P(GeneralisedSolver, HardLawsAreSolvedFromRest) {
  for (const ViscosityLaw& law :
       {ViscosityLaw{PowerLaw{.power_index = 0.2, .floor = 1e-3, .ceiling = 1e3}},
        ViscosityLaw{
            CarreauYasuda{.time_constant = 1e3, .power_index = 0.2, .infinite_ratio = 1e-3}},
        ViscosityLaw{
            CarreauYasuda{.time_constant = 10.0, .power_index = 0.5, .yasuda_exponent = 0.6}},
        ViscosityLaw{PowerLaw{.power_index = 1.8}}, ViscosityLaw{PowerLaw{.power_index = 2.5}}}) {
    const SinkingBlock block(GetParam(), law, law, 4);
    const Solution solution = solve(block, 1e-8);
    EXPECT_TRUE(solution.report.ok()) << solution.report.text();
    EXPECT_EQ(solution.report.solver, LinearSolver::block);
    EXPECT_LT(solution.report.residual, 2.1e-8 * solution.report.reference);
  }
}

// One iteration is no linear solve for a tight tolerance, whichever solver is asked: what was
// reached is told, and the state left alone.
TEST(GeneralisedSolverFailure, NamesTheResidualsOfItsSteps) {
  const SinkingBlock block(Elements::p1_p1, thinning, thinning);
  Options options = options_with(1e-12);
  options.max_iterations = 1;
  StokesSolver solver(block.test.space, options);
  StokesState state = solver.state_at_rest();
  block.problem.constraints.impose(state.v);
  const StokesState before = state;
  PhaseTimes times;
  const StokesReport report =
      solver.solve(block.problem, state, linear::Preconditioner::fresh, times);
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.text().find("no linear solver converged; residuals of the"), std::string::npos)
      << report.text();
  EXPECT_EQ(report.failed_solvers.back().substr(0, 14), "linear solver ");
  EXPECT_EQ(state.v, before.v);
  EXPECT_EQ(state.p, before.p);
}

}  // namespace
}  // namespace meniscus::fem
