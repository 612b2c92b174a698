#include "meniscus/surface/dense_equations.hpp"

#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

DenseEquations equations_of(const Eigen::MatrixXd& matrix) {
  DenseEquations equations;
  equations.reset(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      equations(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = matrix(i, j);
  equations.factorize();
  return equations;
}

TEST(DenseEquations, HaveTheSolutionsOfAnotherElimination) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (int n = 1; n <= static_cast<int>(DenseEquations::kMost); ++n) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return entry(random); });
    if (n > 2) matrix.topLeftCorner(n / 2, n / 2).setZero();  // pivots of zero
    const Eigen::VectorXd right = Eigen::VectorXd::NullaryExpr(n, [&] { return entry(random); }),
                          expected = matrix.fullPivLu().solve(right);
    Eigen::VectorXd found = right;
    equations_of(matrix).solve({found.data(), static_cast<std::size_t>(n)});
    EXPECT_LT((matrix * found - right).norm(), 1e-13 * n * (1.0 + expected.norm())) << n;
    EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm()) << n;
  }
}

TEST(DenseEquations, WithoutASolutionAreNoNumbers) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(5, 5);
  matrix(0, 0) = 1.0;
  std::array<double, 5> values{1.0, 1.0, 0.0, 0.0, 0.0};
  equations_of(matrix).solve(values);
  EXPECT_FALSE(std::isfinite(values[1]));
}

}  // namespace
}  // namespace meniscus
