#include "meniscus/geometry/quadrature.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

double factorial(int n) { return std::tgamma(n + 1.0); }

/// Calls f for every tuple of exponents whose sum is `degree`.
template <std::size_t Corners, class Function>
void for_each_monomial(int degree, Function&& f) {
  std::array<int, Corners> exponents{};
  const auto fill = [&](auto&& self, std::size_t k, int left) -> void {
    if (k + 1 == Corners) {
      exponents[k] = left;
      f(exponents);
      return;
    }
    for (exponents[k] = 0; exponents[k] <= left; ++exponents[k])
      self(self, k + 1, left - exponents[k]);
  };
  fill(fill, 0, degree);
}

/// Largest error of the mean of ∏ b_k^e_k over a simplex of d dimensions, d! ∏ e_k!/(d + Σ e_k)!,
/// over all monomials of a degree.
template <std::size_t Corners>
double largest_error(std::span<const QuadraturePoint<Corners>> rule, int degree) {
  constexpr int kDimensions = static_cast<int>(Corners) - 1;
  double largest = 0.0;
  for_each_monomial<Corners>(degree, [&](const std::array<int, Corners>& exponents) {
    double exact = factorial(kDimensions) / factorial(kDimensions + degree), sum = 0.0;
    for (const int e : exponents) exact *= factorial(e);
    for (const auto& [barycentric, share] : rule) {
      double term = share;
      for (std::size_t k = 0; k < Corners; ++k) term *= std::pow(barycentric[k], exponents[k]);
      sum += term;
    }
    largest = std::max(largest, std::abs(sum - exact));
  });
  return largest;
}

/// Exact to its degree and not beyond.
template <std::size_t Corners>
void expect_degree(std::span<const QuadraturePoint<Corners>> rule, int degree) {
  for (int d = 0; d <= degree; ++d) EXPECT_LT(largest_error(rule, d), 1e-15) << "degree " << d;
  EXPECT_GT(largest_error(rule, degree + 1), 1e-7) << "degree " << degree + 1;
  for (const auto& [barycentric, share] : rule) {
    double sum = 0.0;
    for (const double b : barycentric) sum += b;
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_GT(share, 0.0);
    EXPECT_GT(*std::ranges::min_element(barycentric), 0.0);
  }
}

TEST(Quadrature, RulesHaveTheirDegree) {
  expect_degree(std::span<const QuadraturePoint<3>>(kTriangleRule4), 4);
  expect_degree(std::span<const QuadraturePoint<3>>(kTriangleRule5), 5);
  expect_degree(std::span<const QuadraturePoint<3>>(kTriangleRule6), 6);
  expect_degree(std::span<const QuadraturePoint<4>>(kTetrahedronRule2), 2);
  expect_degree(std::span<const QuadraturePoint<4>>(kTetrahedronRule5), 5);
  for (std::size_t corner = 0; corner < 3; ++corner) expect_degree(corner_rule(corner), 6);
}

TEST(Quadrature, GaussLegendreHasTwiceItsPointsDegree) {
  for (int count = 1; count <= 8; ++count) {
    const std::vector<GaussPoint> points = gauss_legendre(count);
    const auto error = [&](int degree) {
      double sum = -1.0 / (degree + 1);
      for (const auto& [x, weight] : points) sum += weight * std::pow(x, degree);
      return std::abs(sum);
    };
    // Newton's method leaves some 1e-15 of the points, which counts up to 15 times.
    for (int d = 0; d < 2 * count; ++d) EXPECT_LT(error(d), 2e-14) << count << " points, " << d;
    EXPECT_GT(error(2 * count), 1e-12) << count;
  }
}

// ∫ dA/r about a corner of the right triangle of unit legs is √2 ln(1 + √2): 1/r seen from the
// right angle, the distance 1/√2 of the far edge times the logarithm.
TEST(Quadrature, CornerRuleIntegratesOneOverTheDistance) {
  const std::array<std::array<double, 2>, 3> x = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    double sum = 0.0;
    for (const auto& [b, share] : corner_rule(corner)) {
      // The rule's corner at the right angle.
      const double u = b[(corner + 1) % 3] * x[1][0], v = b[(corner + 2) % 3] * x[2][1];
      sum += 0.5 * share / std::hypot(u, v);
    }
    // Along the far edge the integrand is 1/(1 + t²)^½, |t| up to 1, whose poles ±i let Gauss
    // points converge as (1 + √2)^−2n: 4.4e-6 for seven.
    EXPECT_NEAR(sum, std::sqrt(2.0) * std::log(1.0 + std::sqrt(2.0)), 4.4e-6) << corner;
  }
}

}  // namespace
}  // namespace meniscus
