// Run under mpirun too, on two and three ranks (tests/CMakeLists.txt): every rank does every test.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/instant_problem.hpp"
#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/flow/fem/vertex_ranks.hpp"
#include "meniscus/linear/collective.hpp"
#include "tests/flow/fem/sheared_drop.hpp"
#include "tests/flow/fem/straight_space.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {
namespace {

linear::Communicator world() { return linear::Communicator::world(); }

/// Velocities, then pressures.
std::vector<double> numbers(const StokesState& state) {
  std::vector<double> all;
  for (const Vec3& v : state.v) all.insert(all.end(), v.begin(), v.end());
  all.insert(all.end(), state.p.begin(), state.p.end());
  return all;
}

struct Solution {
  StokesReport report;
  StokesState state;
  StokesPower power;
};

Solution solved(const StokesProblem& problem, Options options, linear::Processes processes) {
  options.elements = problem.space.elements;
  options.processes = processes;
  StokesSolver solver(problem.space, options);
  PhaseTimes times;
  Solution solution{{}, solver.state_at_rest(), {}};
  solution.report = solver.solve(problem, solution.state, linear::Preconditioner::fresh, times);
  solution.power = solver.power(problem, solution.state);
  return solution;
}

/// What one process finds alone and all find together; a failure of either fails the test.
struct BothWays {
  Solution alone, together;
};
BothWays solved_both_ways(const StokesProblem& problem, const Options& options) {
  BothWays both{solved(problem, options, linear::Processes::alone),
                solved(problem, options, linear::Processes::all)};
  EXPECT_TRUE(both.alone.report.ok() && both.together.report.ok()) << both.together.report.text();
  return both;
}

double largest_velocity_difference(const StokesState& a, const StokesState& b) {
  double largest = 0.0;
  for (const NodeId i : a.v.ids()) largest = std::max(largest, (a.v[i] - b.v[i]).norm());
  return largest;
}

struct Way {
  Elements elements;
  LinearSolver linear;
};
class RanksBySolver : public testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(EveryOne, RanksBySolver,
                         testing::Values(Way{Elements::p1_p1, LinearSolver::block},
                                         Way{Elements::p1_p1, LinearSolver::minres},
                                         Way{Elements::p1_p1, LinearSolver::paper_gmres},
                                         Way{Elements::p1_p1, LinearSolver::mumps},
                                         Way{Elements::p2_p1, LinearSolver::block},
                                         Way{Elements::p2_p1, LinearSolver::minres},
                                         Way{Elements::p2_p1, LinearSolver::mumps}));

TEST_P(RanksBySolver, TogetherFindWhatOneFindsAlone) {
  const auto [elements, linear_solver] = GetParam();
  const ShearedDrop drop(elements);
  const StokesProblem problem = drop.problem();
  Options options;
  options.linear = linear_solver;
  options.rtol = 1e-10;
  const auto [alone, together] = solved_both_ways(problem, options);
  EXPECT_EQ(together.report.solver, linear_solver);
  EXPECT_LT(together.report.residual, 2.1e-10 * together.report.reference);
  EXPECT_NEAR(together.report.reference, alone.report.reference, 1e-12 * alone.report.reference);
  // The bound of two solvers on one process (stokes_solver_test.cpp).
  EXPECT_LT(largest_velocity_difference(alone.state, together.state), 4e-6);
  for (std::size_t i = 0; i < alone.state.p.size(); ++i)
    EXPECT_NEAR(alone.state.p[i], together.state.p[i], 7e-6);
  EXPECT_NEAR(together.power.dissipation, alone.power.dissipation, 1e-6);
  EXPECT_NEAR(together.power.force, alone.power.force, 1e-6);
  EXPECT_NEAR(together.power.reaction, alone.power.reaction, 1e-5);
  EXPECT_NEAR(together.power.body_force, alone.power.body_force, 1e-6);
  EXPECT_TRUE(linear::agree(world(), std::span<const double>(numbers(together.state))));
  if (world().size() == 1) {
    EXPECT_EQ(numbers(together.state), numbers(alone.state));
  }
}

// The slow modes of a drop reach over the parts of ranks.
TEST(Ranks, ShareSlowModes) {
  Options options;
  options.rtol = 1e-10;
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1})
    for (const double lambda : {0.001, 1000.0}) {
      const Scene scene = stretched_drop(DropShape::dumbbell, 42, lambda);
      TetMesh mesh;
      ASSERT_TRUE(tetrahedralize(scene, suited_volume_mesh(elements), mesh).ok());
      const FlowSpace space = flow_space(mesh, elements);
      const auto [alone, together] = solved_both_ways(instant(scene, mesh, space), options);
      EXPECT_NEAR(together.report.iterations, alone.report.iterations,
                  0.15 * alone.report.iterations);
      EXPECT_LT(largest_velocity_difference(alone.state, together.state), 4e-6);
    }
}

TEST(Ranks, DoTheSameArithmeticAgain) {
  const ShearedDrop drop;
  const StokesProblem problem = drop.problem();
  const Solution first = solved(problem, {}, linear::Processes::all),
                 again = solved(problem, {}, linear::Processes::all);
  ASSERT_TRUE(first.report.ok());
  EXPECT_EQ(numbers(first.state), numbers(again.state));
}

// Slip walls askew: each component has its own Laplacian, and ranks that touch no wall must follow.
TEST(Ranks, AgreeWhereWallsSlip) {
  BoxMesh box = box_mesh(
      {.n = 5, .region = [](const Vec3& x) { return x.norm() < 0.6 ? 1 : 0; }, .jitter = 0.1});
  for (const PatchId patch : box.boundary.patches.ids())
    box.boundary.patches[patch].condition = NoPenetration{};
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    const TestSpace test(box.mesh, elements);
    StokesProblem problem = test.problem();
    for (const CellId c : box.mesh.cells.ids())
      if (box.mesh.region[c] == RegionId{1}) problem.body_force[c] = Vec3(1.0, -2.0, 0.5);
    problem.constraints = test.conditions(box.boundary).constraints;
    Options options;
    options.rtol = 1e-11;
    const auto [alone, together] = solved_both_ways(problem, options);
    EXPECT_LT(largest_velocity_difference(alone.state, together.state), 1e-8);
  }
}

TEST(Ranks, AgreeOnGeneralisedNewtonianLiquids) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    const ShearedDrop drop(elements);
    StokesProblem problem = drop.problem();
    problem.laws.add(Newtonian{});
    problem.laws.add(CarreauYasuda{.time_constant = 2.0, .power_index = 0.5});
    Options options;
    options.rtol = 1e-10;
    const auto [alone, together] = solved_both_ways(problem, options);
    EXPECT_GT(together.report.newton_steps, 1);
    EXPECT_LT(largest_velocity_difference(alone.state, together.state), 4e-6);
    EXPECT_NEAR(together.power.dissipation, alone.power.dissipation, 1e-6);
  }
}

TEST(Ranks, AgreeOnLiquidsWithInertia) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    ShearedDrop drop(elements);
    drop.scene.liquids[RegionId{0}].density = 3.0;
    drop.scene.liquids[RegionId{1}].density = 20.0;
    const NodePositions positions = node_positions(drop.scene, drop.mesh, drop.space);
    ImplicitStage stage = stage_at_rest(drop.scene, 0.2, positions.x);
    for (std::size_t i = 0; i < stage.x.size(); ++i)
      stage.v[i] = stage.expected_v[i] = Vec3(stage.x[i].y(), 0.1, 0.0);
    const FlowDomain domain{drop.scene, &drop.mesh};
    const StokesProblem problem =
        instant_problem(with_stage(domain, stage), drop.space, positions, CapillaryForm::weak, 0.0)
            .stokes;
    EXPECT_FALSE(problem.inertia->tension.empty());
    Options options;
    options.rtol = 1e-10;
    const auto [alone, together] = solved_both_ways(problem, options);
    EXPECT_LT(largest_velocity_difference(alone.state, together.state), 4e-6);
    EXPECT_NEAR(together.power.dissipation, alone.power.dissipation, 1e-5);
    EXPECT_NEAR(together.power.kinetic_rate, alone.power.kinetic_rate, 1e-4);
  }
}

TEST(Ranks, PreparedIsKeptBitForBit) {
  const ShearedDrop drop;
  const StokesProblem problem = drop.problem();
  Options options;
  options.processes = linear::Processes::all;
  PhaseTimes times;
  StokesSolver fresh(drop.space, options), prepared(drop.space, options);
  StokesState a = fresh.state_at_rest(), b = a;
  EXPECT_TRUE(fresh.solve(problem, a, linear::Preconditioner::fresh, times).ok());
  prepared.prepare(problem);
  EXPECT_TRUE(prepared.solve(problem, b, linear::Preconditioner::kept, times).ok());
  EXPECT_EQ(numbers(a), numbers(b));
}

TEST(Ranks, ReportFailuresTogether) {
  const ShearedDrop drop;
  StokesProblem problem = drop.problem();
  Options options;
  options.linear = LinearSolver::paper_gmres;
  options.max_iterations = 60;  // enough for the block solvers, far too few for the paper's
  options.rtol = 1e-6;
  const Solution replaced = solved(problem, options, linear::Processes::all);
  ASSERT_TRUE(replaced.report.ok()) << replaced.report.text();
  EXPECT_EQ(replaced.report.solver, LinearSolver::block);
  problem.force[NodeId{3}][1] = std::nan("");
  const Solution none = solved(problem, options, linear::Processes::all);
  EXPECT_FALSE(none.report.ok());
  EXPECT_NE(none.report.text().find("not finite"), std::string::npos);
}

TEST(Partition, GroupsAreSeveralVerticesEach) {
  const ShearedDrop drop;
  const std::vector<std::int32_t> group = vertex_groups(drop.space);
  std::vector<int> size(drop.space.velocity.cell_nodes.size(), 0);
  for (const std::int32_t g : group) ++size[static_cast<std::size_t>(g)];
  const int num_groups = 1 + *std::ranges::max_element(group);
  for (int g = 0; g < num_groups; ++g) EXPECT_GT(size[static_cast<std::size_t>(g)], 1);
  EXPECT_GT(drop.space.num_vertices(), 8 * num_groups);
}

/// How many corners of cells each class of vertices has.
std::vector<double> corners_of(const FlowSpace& space, const std::vector<std::int32_t>& class_of) {
  std::vector<double> count(1 + static_cast<std::size_t>(std::ranges::max(class_of)), 0.0);
  for (const CellId c : ids<CellId>(space.velocity.num_cells()))
    for (const std::int32_t v : space.velocity.of(c))
      count[static_cast<std::size_t>(class_of[static_cast<std::size_t>(v)])] += 1.0;
  return count;
}

TEST(Ranks, ShareOutTheWork) {
  const ShearedDrop drop;
  const int size = world().size();
  const double even = 4.0 * drop.mesh.num_cells() / size;
  const double heaviest = std::ranges::max(corners_of(drop.space, vertex_groups(drop.space)));
  // PT-Scotch is asked for a hundredth, and can only give away whole groups.
  for (const double each : corners_of(drop.space, vertex_ranks(drop.space, world())))
    EXPECT_NEAR(each, even, 0.01 * even + heaviest);
}

TEST(Ranks, SharesCoverTheWholeOnce) {
  const ShearedDrop drop(Elements::p2_p1);
  const auto partition = make_partition(drop.space, world());
  if (world().size() == 1) {
    EXPECT_EQ(partition, nullptr);
    return;
  }
  const auto total = [](std::int32_t own) { return linear::sum(world(), std::int64_t{own}); };
  EXPECT_EQ(total(partition->owned.num_nodes), drop.space.velocity.num_nodes);
  EXPECT_EQ(total(partition->owned.num_pressures), drop.space.pressure.nodes.num_nodes);
  EXPECT_EQ(total(partition->owned.num_cells), drop.mesh.num_cells());
  EXPECT_EQ(total(partition->coarse.num_owned), drop.mesh.num_vertices());
  // The state goes out and comes back.
  StokesState state = state_at_rest(drop.space), back = state;
  for (const NodeId i : state.v.ids()) state.v[i] = Vec3(i.value, 1.0, 2.0);
  for (std::size_t i = 0; i < state.p.size(); ++i) state.p[i] = 0.5 * static_cast<double>(i);
  gather_state(local_part(state, *partition), *partition, back);
  EXPECT_EQ(state.v, back.v);
  EXPECT_EQ(state.p, back.p);
}

TEST(Ranks, MoreThanThereIsWorkForAreRefused) {
  const BoxMesh box = box_mesh({.n = 1, .region = [](const Vec3&) { return 0; }});
  const FlowSpace space = flow_space(box.mesh, Elements::p1_p1);
  if (world().size() > 1) {
    EXPECT_THROW((void)make_partition(space, world()), InvalidInput);
  }
}

}  // namespace
}  // namespace meniscus::fem
