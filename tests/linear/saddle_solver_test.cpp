#include "meniscus/linear/saddle_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"

namespace meniscus::linear {
namespace {

/// Dense rows, made sparse.
CsrMatrix sparse(const std::vector<std::vector<double>>& rows) {
  CsrMatrix matrix;
  matrix.num_columns = static_cast<std::int32_t>(rows.front().size());
  matrix.row_start.push_back(0);
  for (const auto& row : rows) {
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j] != 0.0) {
        matrix.columns.push_back(static_cast<std::int32_t>(j));
        matrix.values.push_back(row[j]);
      }
    matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
  }
  return matrix;
}

using Dense = std::vector<std::vector<double>>;
Dense zeros(int rows, int columns) {
  return Dense(std::size_t(rows), std::vector<double>(std::size_t(columns), 0.0));
}

/// A chain of n nodes: Laplacians with fixed ends per component, the first two coupled; pressures
/// on nodes with the divergence of the first component.
struct Chain {
  CsrMatrix A, B, C, laplacian;
  std::vector<double> mass;
  SaddleSystem system;

  explicit Chain(int n, bool is_closed) {
    Dense a = zeros(3 * n, 3 * n), b = zeros(n, 3 * n), c = zeros(n, n), l = zeros(n, n);
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    for (int i = 0; i < n; ++i) {
      l[at(i)][at(i)] = 2.0;
      if (i > 0) l[at(i)][at(i - 1)] = l[at(i - 1)][at(i)] = -1.0;
      c[at(i)][at(i)] = 0.1 * (i > 0) + 0.1 * (i + 1 < n);
      if (i > 0) c[at(i)][at(i - 1)] = c[at(i - 1)][at(i)] = -0.1;
    }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < 3; ++k) a[at(3 * i + k)][at(3 * j + k)] = (1.0 + k) * l[at(i)][at(j)];
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        a[at(3 * i)][at(3 * j + 1)] = a[at(3 * j + 1)][at(3 * i)] = 0.5 * l[at(i)][at(j)];
    // Central differences; their columns sum to zero where the ends are closed.
    for (int i = 0; i + 1 < n; ++i) {
      b[at(i)][at(3 * i)] += 0.5;
      b[at(i)][at(3 * i + 3)] += 0.5;
      b[at(i + 1)][at(3 * i)] -= 0.5;
      b[at(i + 1)][at(3 * i + 3)] -= 0.5;
    }
    if (!is_closed) b[0][0] += 1.0;
    A = sparse(a), B = sparse(b), C = sparse(c), laplacian = sparse(l);
    mass.assign(at(n), 1.0);
    system = {A.view(), B.view(), C.view(), {laplacian.view()}, {0, 0, 0}, mass, is_closed};
  }
};

std::vector<double> product(const CsrView& matrix, std::span<const double> x) {
  std::vector<double> y(std::size_t(matrix.num_rows), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i)
    for (auto k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
      y[i] += matrix.values[std::size_t(k)] * x[std::size_t(matrix.columns[std::size_t(k)])];
  return y;
}

std::vector<double> random_solution(const SaddleSystem& system, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> u(std::size_t(system.size()));
  for (double& value : u) value = uniform(random);
  if (!system.constant_pressure_is_null) return u;
  const auto p = std::span(u).subspan(std::size_t(system.num_velocities()));
  const double mean = std::accumulate(p.begin(), p.end(), 0.0) / double(p.size());
  for (double& value : p) value -= mean;
  return u;
}

double distance(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

struct Case {
  SaddleMethod method;
  bool is_closed;
};
void PrintTo(const Case& each, std::ostream* out) {
  *out << name(each.method) << (each.is_closed ? ", closed" : ", open");
}

class EveryMethod : public testing::TestWithParam<Case> {};

TEST_P(EveryMethod, FindsTheSolution) {
  const auto [method, is_closed] = GetParam();
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Chain chain(20, is_closed);  // 80 unknowns: fewer than GMRES keeps before it restarts
    const std::vector<double> exact = random_solution(chain.system, seed);
    const std::vector<double> side = product(merged(chain.system, 1.0, 0.0).view(), exact);
    SaddleSolver solver(Communicator::self(), {.method = method, .petsc_options = {}});
    std::vector<double> u(exact.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-12);
    ASSERT_TRUE(report.converged) << report.reason;
    // Tolerance times the condition of the chain, (2n/π)² · 6 ~ 1e3, with room for the pressures.
    EXPECT_LT(distance(u, exact), 1e-7) << name(method) << " seed " << seed;
    ASSERT_FALSE(report.residuals.empty());
    EXPECT_LE(report.residuals.back(), 1e-12 * report.residuals.front());
    // A second system of the same size with what was kept of the first.
    std::ranges::fill(u, 0.0);
    const Chain again(20, is_closed);
    const LinearReport kept = solver.solve(again.system, side, u, 1e-12, Preconditioner::kept);
    ASSERT_TRUE(kept.converged) << kept.reason;
    EXPECT_LT(distance(u, exact), 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(
    OpenAndClosed, EveryMethod,
    testing::Values(Case{SaddleMethod::block, false}, Case{SaddleMethod::block, true},
                    Case{SaddleMethod::paper_gmres, false}, Case{SaddleMethod::paper_gmres, true},
                    Case{SaddleMethod::minres, false}, Case{SaddleMethod::minres, true},
                    Case{SaddleMethod::mumps, false}, Case{SaddleMethod::mumps, true}));

TEST(SaddleSolver, NoConvergenceIsReported) {
  const Chain chain(60, true);
  const std::vector<double> exact = random_solution(chain.system, 3);
  const std::vector<double> side = product(merged(chain.system, 1.0, 0.0).view(), exact);
  for (const SaddleMethod method :
       {SaddleMethod::block, SaddleMethod::paper_gmres, SaddleMethod::minres}) {
    SaddleSolver solver(Communicator::self(),
                        {.method = method, .max_iterations = 2, .petsc_options = {}});
    std::vector<double> u(exact.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-14);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.reason, "DIVERGED_ITS");
    EXPECT_EQ(report.iterations, 2);
    EXPECT_EQ(report.residuals.size(), 3u);
  }
}

TEST(SaddleSolver, NotANumberIsReported) {
  const Chain chain(20, false);
  std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  side[5] = std::nan("");
  for (const SaddleMethod method : {SaddleMethod::block, SaddleMethod::paper_gmres,
                                    SaddleMethod::minres, SaddleMethod::mumps}) {
    SaddleSolver solver(Communicator::self(), {.method = method, .petsc_options = {}});
    std::vector<double> u(side.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
    EXPECT_FALSE(report.converged) << name(method);
    EXPECT_FALSE(report.reason.empty());
  }
}

TEST(SaddleSolver, SingularSystemIsReportedByTheDirectMethod) {
  Chain chain(20, false);
  for (double& value : chain.A.values) value = 0.0;
  for (double& value : chain.B.values) value = 0.0;
  const std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  SaddleSolver solver(Communicator::self(), {.method = SaddleMethod::mumps, .petsc_options = {}});
  std::vector<double> u(side.size(), 0.0);
  const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
}

TEST(SaddleSolver, OptionsOverrideTheMethod) {
  const Chain chain(60, true);
  const std::vector<double> exact = random_solution(chain.system, 1);
  const std::vector<double> side = product(merged(chain.system, 1.0, 0.0).view(), exact);
  std::vector<double> u(exact.size(), 0.0);
  SaddleSolver limited(Communicator::self(), {.petsc_options = "-ksp_max_it 3"});
  EXPECT_EQ(limited.solve(chain.system, side, u, 1e-14).iterations, 3);
  std::ranges::fill(u, 0.0);
  SaddleSolver other(Communicator::self(), {.petsc_options = "-v_pc_type gamg"});
  EXPECT_TRUE(other.solve(chain.system, side, u, 1e-10).converged);
  EXPECT_LT(distance(u, exact), 1e-5);
}

TEST(SaddleSolver, OptionsThatPetscCannotReadAreRefused) {
  EXPECT_THROW(SaddleSolver(Communicator::self(), {.petsc_options = "ksp_type minres"}),
               InvalidInput);
}

TEST(SaddleSolver, PreparedIsKept) {
  const Chain chain(20, true);
  const std::vector<double> exact = random_solution(chain.system, 2);
  const std::vector<double> side = product(merged(chain.system, 1.0, 0.0).view(), exact);
  for (const SaddleMethod method : {SaddleMethod::block, SaddleMethod::mumps}) {
    const SaddleOptions options = {.method = method, .petsc_options = {}};
    SaddleSolver fresh(Communicator::self(), options), prepared(Communicator::self(), options);
    std::vector<double> a(exact.size(), 0.0), b(exact.size(), 0.0);
    const LinearReport first = fresh.solve(chain.system, side, a, 1e-8);
    prepared.prepare(chain.system);
    const LinearReport second = prepared.solve(chain.system, side, b, 1e-8, Preconditioner::kept);
    EXPECT_TRUE(first.converged && second.converged);
    EXPECT_EQ(a, b);  // bit for bit
  }
}

TEST(SaddleSystem, MergedMatrixHasSignAndPin) {
  const Chain chain(3, true);
  const CsrMatrix plus = merged(chain.system, 1.0, 0.0), minus = merged(chain.system, -1.0, 7.0);
  std::vector<double> u(12, 0.0);
  u[9] = 1.0;  // the first pressure
  const auto column = product(plus.view(), u), flipped = product(minus.view(), u);
  EXPECT_DOUBLE_EQ(column[0], 0.5);  // Bᵀ
  EXPECT_DOUBLE_EQ(column[9], -0.1);
  EXPECT_DOUBLE_EQ(flipped[0], 0.5);
  EXPECT_DOUBLE_EQ(flipped[9], 0.1 + 7.0);
  EXPECT_DOUBLE_EQ(flipped[10], -0.1);
}

TEST(Communicator, OneProcessAlone) {
  EXPECT_EQ(Communicator::self().size(), 1);
  EXPECT_EQ(Communicator::world().rank(), 0);
}

}  // namespace
}  // namespace meniscus::linear
