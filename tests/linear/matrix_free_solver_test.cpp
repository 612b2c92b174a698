#include "meniscus/linear/matrix_free_solver.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace meniscus::linear {
namespace {

constexpr std::size_t kSize = 40;

/// I plus a random matrix of norm below 1: neither symmetric nor close to it.
std::vector<std::vector<double>> random_matrix(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.5 / kSize, 1.0 / kSize);
  std::vector<std::vector<double>> a(kSize, std::vector<double>(kSize));
  for (std::size_t i = 0; i < kSize; ++i)
    for (std::size_t j = 0; j < kSize; ++j) a[i][j] = uniform(random) + (i == j ? 1.0 : 0.0);
  return a;
}

LinearOperator product(const std::vector<std::vector<double>>& a) {
  return [&a](std::span<const double> x, std::span<double> result) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      result[i] = 0.0;
      for (std::size_t j = 0; j < x.size(); ++j) result[i] += a[i][j] * x[j];
    }
  };
}

std::vector<double> random_vector(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> x(kSize);
  for (double& each : x) each = normal(random);
  return x;
}

TEST(MatrixFreeSolver, FindsTheSolutionFromAnyGuess) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto a = random_matrix(seed);
    const std::vector<double> exact = random_vector(10 + seed);
    std::vector<double> b(kSize), x = random_vector(20 + seed);
    product(a)(exact, b);
    const LinearReport report = solve_matrix_free(product(a), b, x, {.rtol = 1e-13});
    EXPECT_TRUE(report.converged) << report.reason;
    for (std::size_t i = 0; i < kSize; ++i) EXPECT_NEAR(x[i], exact[i], 1e-11);
    const LinearReport again = solve_matrix_free(product(a), b, x, {.rtol = 1e-10});
    EXPECT_TRUE(again.converged);
    EXPECT_EQ(again.iterations, 0);
  }
}

TEST(MatrixFreeSolver, ReportsThatItDidNotConverge) {
  const auto a = random_matrix(4);
  const std::vector<double> b = random_vector(5);
  std::vector<double> x(kSize, 0.0);
  const LinearReport report =
      solve_matrix_free(product(a), b, x, {.rtol = 1e-14, .max_iterations = 1});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_EQ(report.reason, "DIVERGED_ITS");
}

TEST(MatrixFreeSolver, AnOperatorThatThrowsEndsInAReport) {
  std::vector<double> x(kSize, 0.0);
  const LinearReport report = solve_matrix_free(
      [](std::span<const double>, std::span<double>) { throw std::runtime_error("broken"); },
      random_vector(6), x, {});
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
}

}  // namespace
}  // namespace meniscus::linear
