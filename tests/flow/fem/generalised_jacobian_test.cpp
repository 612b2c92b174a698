// The Jacobian of generalised-Newtonian liquids against differences of the residual.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

const CarreauYasuda thinning{
    .time_constant = 1.5, .power_index = 0.3, .yasuda_exponent = 1.4, .infinite_ratio = 0.05};
const PowerLaw power_law{.power_index = 0.5, .floor = 1e-3, .ceiling = 1e3};
const PowerLaw thickening{.power_index = 1.6, .floor = 1e-3, .ceiling = 1e3};

struct TestCase {
  Elements elements;
  ViscosityLaw matrix, drop;
};

/// A block in a box under random conditions: some nodes fixed, some sliding on slanted planes.
struct RandomProblem {
  BoxMesh box;
  TestSpace test;
  StokesProblem problem;
  std::mt19937 random{5};

  explicit RandomProblem(const TestCase& given)
      : box(box_mesh(
            {.n = 2, .region = [](const Vec3& x) { return x.x() < 0.0 ? 1 : 0; }, .jitter = 0.1})),
        test(box.mesh, given.elements),
        problem(test.problem()) {
    if (given.elements == Elements::p2_p1) bend();
    for (const CellId c : box.mesh.cells.ids()) {
      problem.viscosity[c] = box.mesh.region[c] == RegionId{1} ? 3.0 : 1.0;
      problem.body_force[c] = Vec3(0.4, -0.2, 0.9);
    }
    problem.laws.add(given.matrix);
    problem.laws.add(given.drop);
    const std::vector<Vec3> slanted = {Vec3(1.0, 2.0, -0.5).normalized()};
    for (std::int32_t i = 0; i < problem.force.size(); i += 5)
      problem.constraints.forbid_penetration(NodeId{i}, slanted);
    for (std::int32_t i = 2; i < problem.force.size(); i += 7)
      problem.constraints.fix(NodeId{i}, draw());
  }
  void bend() {
    for (std::size_t e = 0; e < test.space.edges.size(); e += 3)
      problem.positions.x[NodeId{test.space.num_vertices() + static_cast<std::int32_t>(e)}] +=
          0.05 * draw();
    settle_curved_cells(box.mesh, test.space, {}, problem.positions);
  }
  Vec3 draw() {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
  }
  StokesState draw_state() {
    StokesState state = state_at_rest(test.space);
    for (Vec3& v : state.v) v = draw();
    for (double& p : state.p) p = draw().x();
    return state;
  }
};

/// What the solver's unknowns make of a state: the components in the constraints' frames, the fixed
/// ones zero.
std::vector<double> unknowns(const Field<NodeId, Vec3>& v, const std::vector<double>& p,
                             const Constraints& constraints) {
  std::vector<double> values;
  for (const NodeId i : v.ids()) {
    Vec3 local = v[i];
    if (const NodeConstraint* constraint = constraints.find(i)) {
      local = constraint->frame.transpose() * (v[i] - constraint->fixed_part(v[i]));
    }
    values.insert(values.end(), {local.x(), local.y(), local.z()});
  }
  values.insert(values.end(), p.begin(), p.end());
  return values;
}

void add_product(const linear::CsrView& matrix, std::span<const double> x, double factor,
                 std::span<double> y) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(matrix.num_rows); ++i)
    for (auto k = static_cast<std::size_t>(matrix.row_start[i]);
         k < static_cast<std::size_t>(matrix.row_start[i + 1]); ++k)
      y[i] += factor * matrix.values[k] * x[static_cast<std::size_t>(matrix.columns[k])];
}

void add_transposed(const linear::CsrView& matrix, std::span<const double> x, std::span<double> y) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(matrix.num_rows); ++i)
    for (auto k = static_cast<std::size_t>(matrix.row_start[i]);
         k < static_cast<std::size_t>(matrix.row_start[i + 1]); ++k)
      y[static_cast<std::size_t>(matrix.columns[k])] += matrix.values[k] * x[i];
}

std::vector<double> times(const linear::SaddleSystem& system, std::span<const double> x) {
  std::vector<double> y(x.size(), 0.0);
  const auto n = static_cast<std::size_t>(system.num_velocities());
  const auto xv = x.first(n), xp = x.subspan(n);
  const auto yv = std::span(y).first(n), yp = std::span(y).subspan(n);
  add_product(system.A, xv, 1.0, yv);
  add_transposed(system.B, xp, yv);
  add_product(system.lower_left_block(), xv, 1.0, yp);
  add_product(system.C, xp, -1.0, yp);
  return y;
}

StokesState sum(const StokesState& a, double factor, const StokesState& b) {
  StokesState result = a;
  for (const NodeId i : a.v.ids()) result.v[i] += factor * b.v[i];
  for (std::size_t i = 0; i < a.p.size(); ++i) result.p[i] += factor * b.p[i];
  return result;
}

class GeneralisedJacobian : public testing::TestWithParam<TestCase> {};
INSTANTIATE_TEST_SUITE_P(Laws, GeneralisedJacobian,
                         testing::Values(TestCase{Elements::p1_p1, thinning, Newtonian{}},
                                         TestCase{Elements::p1_p1, Newtonian{}, power_law},
                                         TestCase{Elements::p1_p1, thickening, thinning},
                                         TestCase{Elements::p2_p1, thinning, Newtonian{}},
                                         TestCase{Elements::p2_p1, Newtonian{}, power_law},
                                         TestCase{Elements::p2_p1, thickening, thinning}));

TEST_P(GeneralisedJacobian, IsTheDerivativeOfTheResidual) {
  RandomProblem random(GetParam());
  const StokesProblem& problem = random.problem;
  StokesJacobian jacobian(random.test.space);
  for (int draw = 0; draw < 3; ++draw) {
    StokesState state = random.draw_state(), direction = random.draw_state();
    problem.constraints.impose(state.v);
    for (const NodeConstraint& constraint : problem.constraints.all()) {
      Vec3& v = direction.v[constraint.node];
      v -= constraint.fixed_part(v);
    }
    const Linearization about{state, Linearization::Kind::newton};
    jacobian.assemble(problem, &about);
    const std::vector<double> product =
        times(jacobian.system(), unknowns(direction.v, direction.p, problem.constraints));
    const double step = 1e-5;
    const StokesResidual right = residual(problem, sum(state, step, direction)),
                         left = residual(problem, sum(state, -step, direction));
    const std::vector<double> ahead =
        unknowns(right.momentum, right.continuity, problem.constraints);
    const std::vector<double> behind =
        unknowns(left.momentum, left.continuity, problem.constraints);
    double largest = 0.0, error = 0.0;
    for (std::size_t i = 0; i < product.size(); ++i) {
      largest = std::max(largest, std::abs(product[i]));
      error = std::max(error, std::abs((ahead[i] - behind[i]) / (2.0 * step) - product[i]));
    }
    // step² times third derivatives, and roundoff over step: 1e-10 each; the smallest rates of
    // strain, a twentieth of the mean, enlarge the first by some thousand.
    EXPECT_LT(error, 1e-6 * largest) << "seed 5, draw " << draw;
  }
}

TEST_P(GeneralisedJacobian, HasASymmetricPositiveVelocityBlock) {
  RandomProblem random(GetParam());
  StokesJacobian jacobian(random.test.space);
  const StokesState state = random.draw_state();
  const Linearization about{state, Linearization::Kind::newton};
  jacobian.assemble(random.problem, &about);
  const linear::SaddleSystem system = jacobian.system();
  for (int draw = 0; draw < 10; ++draw) {
    const StokesState a = random.draw_state(), b = random.draw_state();
    const std::vector<double> x = unknowns(a.v, {}, random.problem.constraints),
                              y = unknowns(b.v, {}, random.problem.constraints);
    const auto form = [&](const std::vector<double>& left, const std::vector<double>& right) {
      std::vector<double> product(right.size(), 0.0);
      add_product(system.A, right, 1.0, product);
      return std::inner_product(left.begin(), left.end(), product.begin(), 0.0);
    };
    const double scale = std::sqrt(form(x, x) * form(y, y));
    EXPECT_GT(form(x, x), 0.0);
    EXPECT_NEAR(form(x, y), form(y, x), 1e-13 * scale);
  }
}

// Picard's matrix is the residual's own where the stress is linear in the velocity at fixed
// viscosity: J u − (loads) = R(u).
TEST_P(GeneralisedJacobian, OfPicardGivesTheResidualItself) {
  RandomProblem random(GetParam());
  StokesProblem problem = random.problem;
  problem.constraints = Constraints(problem.force.size());
  for (Vec3& force : problem.body_force) force.setZero();
  StokesJacobian jacobian(random.test.space);
  const StokesState state = random.draw_state();
  const Linearization about{state, Linearization::Kind::picard};
  jacobian.assemble(problem, &about);
  EXPECT_TRUE(jacobian.system().lower_left.empty());
  const std::vector<double> product =
      times(jacobian.system(), unknowns(state.v, state.p, problem.constraints));
  const StokesResidual now = residual(problem, state);
  const std::vector<double> wanted = unknowns(now.momentum, now.continuity, problem.constraints);
  double largest = 0.0;
  for (const double each : wanted) largest = std::max(largest, std::abs(each));
  for (std::size_t i = 0; i < product.size(); ++i)
    EXPECT_NEAR(product[i], wanted[i], 1e-12 * largest);
}

}  // namespace
}  // namespace meniscus::fem
