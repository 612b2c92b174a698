#include "meniscus/flow/fem/stokes_product.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/stokes_jacobian.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/sheared_drop.hpp"

namespace meniscus::fem {
namespace {

std::vector<double> noise(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(size);
  for (double& value : values) value = uniform(generator);
  return values;
}

/// Adds M x, or Mᵀ x.
void add_product(const linear::CsrView& M, std::span<const double> x, std::span<double> y) {
  for (std::size_t i = 0; i < std::size_t(M.num_rows); ++i)
    for (auto k = std::size_t(M.row_start[i]); k < std::size_t(M.row_start[i + 1]); ++k)
      y[i] += M.values[k] * x[std::size_t(M.columns[k])];
}
void add_transposed_product(const linear::CsrView& M, std::span<const double> x,
                            std::span<double> y) {
  for (std::size_t i = 0; i < std::size_t(M.num_rows); ++i)
    for (auto k = std::size_t(M.row_start[i]); k < std::size_t(M.row_start[i + 1]); ++k)
      y[std::size_t(M.columns[k])] += M.values[k] * x[i];
}

void expect_same(std::span<const double> values, std::span<const double> wanted) {
  ASSERT_EQ(values.size(), wanted.size());
  double largest = 0.0;
  for (const double each : wanted) largest = std::max(largest, std::abs(each));
  EXPECT_GT(largest, 0.0);
  // Sums of some hundred terms in another order, which may each be larger than the largest sum.
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_NEAR(values[i], wanted[i], 1e-12 * largest) << i;
}

/// A drop of curved cells among straight ones, and noise for its unknowns.
class StokesProductOfDrop : public testing::Test {
 protected:
  StokesProductOfDrop() : problem_(drop_.problem()), jacobian_(problem_.space) {
    problem_.constraints = Constraints(problem_.space.velocity.num_nodes);
    jacobian_.assemble(problem_);
  }
  const ShearedDrop drop_{Elements::p2_p1};
  StokesProblem problem_;
  StokesJacobian jacobian_;
  const std::size_t num_velocities_ = 3 * std::size_t(problem_.space.velocity.num_nodes),
                    num_pressures_ = problem_.space.pressure.vertex.size();
  const std::vector<double> v_ = noise(num_velocities_, 1), p_ = noise(num_pressures_, 2);
};

TEST_F(StokesProductOfDrop, IsThatOfTheMatrices) {
  EXPECT_GT(std::ranges::count(problem_.positions.is_curved, char{true}), 8);
  const linear::SaddleSystem system = jacobian_.system();
  std::vector<double> momentum(num_velocities_), continuity(num_pressures_), wanted = momentum,
                                                                             wanted_p = continuity;
  StokesProduct(problem_).add(v_, p_, momentum, continuity);
  add_product(system.A, v_, wanted);
  add_transposed_product(system.B, p_, wanted);
  add_product(system.B, v_, wanted_p);
  expect_same(momentum, wanted);
  expect_same(continuity, wanted_p);
}

TEST_F(StokesProductOfDrop, HasThePressuresPartOnStraightCells) {
  std::vector<double> momentum(num_velocities_), wanted(num_velocities_);
  StokesProduct(problem_).add_straight_gradient(p_, momentum);
  StokesProblem straight = problem_;
  std::ranges::fill(straight.positions.is_curved, char{false});
  jacobian_.assemble(straight);
  add_transposed_product(jacobian_.system().B, p_, wanted);
  expect_same(momentum, wanted);
}

TEST_F(StokesProductOfDrop, PassesOverCellsAtRest) {
  std::vector<double> v(num_velocities_), p(num_pressures_);
  std::copy_n(v_.begin(), 30, v.begin());
  p[7] = 1.0;
  std::vector<double> momentum(num_velocities_), continuity(num_pressures_), wanted = momentum,
                                                                             wanted_p = continuity;
  const StokesProduct product(problem_);
  product.add_stress_of_few(v, p, momentum, continuity);
  product.add_stress(v, p, wanted, wanted_p);
  EXPECT_EQ(momentum, wanted);
  EXPECT_EQ(continuity, wanted_p);
}

TEST_F(StokesProductOfDrop, GivesTheDissipationOfAnyStateByItsResidual) {
  StokesState state = StokesSolver(problem_.space, {}).state_at_rest();
  for (const NodeId i : state.v.ids())
    state.v[i] = Vec3::Map(&v_[3 * static_cast<std::size_t>(i.value)]);
  state.p = p_;
  ASSERT_TRUE(
      std::ranges::any_of(problem_.body_force, [](const Vec3& f) { return f.norm() > 0.0; }));
  std::vector<double> momentum(num_velocities_), continuity(num_pressures_);
  StokesProduct(problem_).add_stress(v_, std::vector<double>(num_pressures_), momentum, continuity);
  const double wanted = std::inner_product(v_.begin(), v_.end(), momentum.begin(), 0.0);
  EXPECT_NEAR(power(problem_, state).dissipation, wanted, 1e-11 * wanted);
}

}  // namespace
}  // namespace meniscus::fem
