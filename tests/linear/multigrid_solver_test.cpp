#include "meniscus/linear/multigrid_solver.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/linear/chain.hpp"

namespace meniscus::linear {
namespace {

/// Seven-point differences of −∇·(μ∇u) on a cube of n³ points between walls, μ rising by a factor
/// of a hundred from one side to the other.
CsrMatrix graded_laplacian(int n) {
  CsrMatrix matrix;
  matrix.num_columns = n * n * n;
  matrix.row_start.push_back(0);
  const std::array<std::array<int, 3>, 7> stencil{
      {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto weight = [&](double x) { return std::pow(100.0, x / n); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        for (const auto& [a, b, c] : stencil) {
          const bool is_diagonal = a == 0 && b == 0 && c == 0;
          const auto is_within = [&](int at) { return at >= 0 && at < n; };
          if (!is_within(i + a) || !is_within(j + b) || !is_within(k + c)) continue;
          const double across = weight(i - 0.5) + weight(i + 0.5) + 4.0 * weight(i);
          matrix.columns.push_back((i + a) + n * ((j + b) + n * (k + c)));
          matrix.values.push_back(is_diagonal ? across : -weight(i + 0.5 * a));
        }
        matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
      }
  return matrix;
}

struct Solved {
  LinearReport report;
  std::vector<double> solution;
  double error = 0.0;
};
Solved solved(int n) {
  const CsrMatrix matrix = graded_laplacian(n);
  std::vector<double> exact(static_cast<std::size_t>(matrix.num_columns));
  for (std::size_t i = 0; i < exact.size(); ++i) exact[i] = std::sin(0.37 * static_cast<double>(i));
  const std::vector<double> right = product(matrix.view(), exact);
  Solved result{{}, std::vector<double>(exact.size(), 1.0)};
  const MultigridSolver solver(matrix.view());
  result.report = solver.solve(right, result.solution, 1e-10, 100);
  result.error = distance(result.solution, exact);
  return result;
}

TEST(MultigridSolver, TakesAsManyIterationsWithManyUnknownsAsWithFew) {
  const Solved coarse = solved(8), fine = solved(32);
  EXPECT_TRUE(coarse.report.converged) << coarse.report.reason;
  EXPECT_TRUE(fine.report.converged) << fine.report.reason;
  // The residual's tolerance times the conditioning, n² and the range of μ.
  EXPECT_LT(coarse.error, 1e-10 * 8 * 8 * 100);
  EXPECT_LT(fine.error, 1e-10 * 32 * 32 * 100);
  // Of conjugate gradients with Jacobi's preconditioner four times as many.
  EXPECT_LT(fine.report.iterations, 2 * coarse.report.iterations);
}

TEST(MultigridSolver, GivesTheSameBitsAgain) {
  EXPECT_EQ(solved(12).solution, solved(12).solution);
}

TEST(MultigridSolver, LeavesAnIterateThatWasCutShort) {
  const CsrMatrix matrix = graded_laplacian(8);
  std::vector<double> right(512, 1.0), solution(512);
  const LinearReport report = MultigridSolver(matrix.view()).solve(right, solution, 1e-14, 2);
  EXPECT_FALSE(report.converged);
  const std::vector<double> image = product(matrix.view(), solution);
  double squared = 0.0;
  for (const double each : image) squared += (each - 1.0) * (each - 1.0);
  EXPECT_LT(std::sqrt(squared), 0.5 * std::sqrt(512.0));
}

TEST(MultigridSolver, SolvesForNothing) {
  const CsrMatrix matrix = graded_laplacian(4);
  const std::vector<double> right(64, 0.0);
  std::vector<double> solution(64, 1.0);
  EXPECT_TRUE(MultigridSolver(matrix.view()).solve(right, solution, 1e-6, 10).converged);
  EXPECT_EQ(solution, right);
}

}  // namespace
}  // namespace meniscus::linear
