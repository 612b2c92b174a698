#include "meniscus/surface/spline_equations.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

using Place = SplineEquations::Place;
constexpr auto kTerms = static_cast<Eigen::Index>(SplineEquations::kLeast);

std::vector<Place> random_places(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::vector<Place> places(count);
  for (Place& place : places) place = {coordinate(random), coordinate(random)};
  return places;
}

std::vector<double> weights_at(const Place& x, std::span<const Place> places) {
  SplineEquations equations;
  equations.set(places);
  std::vector<double> weights(places.size());
  equations.weights(x, weights);
  return weights;
}

Eigen::VectorXd terms_at(const Place& x) {
  Eigen::VectorXd terms(kTerms);
  terms << 1.0, monomials<4>(x.x(), x.y());
  return terms;
}

/// The weights by elimination of the whole matrix with full pivoting, in numbers with 64 bits of
/// significand.
Eigen::VectorXd weights_of_the_whole_matrix(const Place& x, std::span<const Place> places) {
  using Real = long double;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  const auto n = static_cast<Eigen::Index>(places.size());
  const auto spline = [](const Place& a, const Place& b) {
    return std::pow((a.cast<Real>() - b.cast<Real>()).norm(), Real(7));
  };
  Matrix matrix = Matrix::Zero(n + kTerms, n + kTerms);
  Vector right(n + kTerms);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Place& here = places[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j)
      matrix(i, j) = spline(here, places[static_cast<std::size_t>(j)]);
    matrix.row(i).tail(kTerms) = terms_at(here).cast<Real>();
    matrix.col(i).tail(kTerms) = terms_at(here).cast<Real>();
    right[i] = spline(x, here);
  }
  right.tail(kTerms) = terms_at(x).cast<Real>();
  return matrix.fullPivLu().solve(right).head(n).cast<double>();
}

TEST(SplineEquations, HaveTheWeightsOfTheWholeMatrix) {
  for (std::size_t count = SplineEquations::kLeast; count <= SplineEquations::kMost; ++count) {
    const std::vector<Place> places = random_places(count, static_cast<unsigned>(count));
    for (const Place& x : {Place(0.0, 0.0), Place(0.3, -0.2), Place(-0.9, 0.8)}) {
      const std::vector<double> found = weights_at(x, places);
      const Eigen::VectorXd expected = weights_of_the_whole_matrix(x, places);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-10 * expected.norm())
            << count << " places";
    }
  }
}

TEST(SplineEquations, HaveTheSameWeightsAtAnyScale) {
  const std::vector<Place> places = random_places(SplineEquations::kMost, 5);
  const Place x(0.1, 0.2);
  const std::vector<double> expected = weights_at(x, places);
  for (const double scale : {1e-6, 0.1, 3.0, 1e6}) {
    std::vector<Place> scaled = places;
    for (Place& place : scaled) place *= scale;
    const std::vector<double> found = weights_at(scale * x, scaled);
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9);
  }
}

TEST(SplineEquations, ReproducePolynomialsOfDegreeFour) {
  const std::vector<Place> places = random_places(SplineEquations::kMost, 1);
  const Place x(0.2, -0.35);
  const std::vector<double> weights = weights_at(x, places);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(kTerms);
  for (std::size_t i = 0; i < places.size(); ++i) sum += weights[i] * terms_at(places[i]);
  EXPECT_LT((sum - terms_at(x)).norm(), 1e-12);
}

TEST(SplineEquations, TakeTheValueOfAPlaceThere) {
  const std::vector<Place> places = random_places(24, 2);
  const std::vector<double> weights = weights_at(places[7], places);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(weights[i], i == 7 ? 1.0 : 0.0, 1e-10);
}

TEST(SplineEquations, GiveUpOnPlacesThatDoNotDetermineThem) {
  const auto is_given_up = [](std::span<const Place> places) {
    double sum = 0.0;
    for (const double weight : weights_at({0.1, 0.05}, places)) sum += std::abs(weight);
    return !(sum < 1e6);
  };
  std::vector<Place> on_a_line = random_places(30, 3);
  for (Place& place : on_a_line) place.y() = 0.5 * place.x();
  EXPECT_TRUE(is_given_up(on_a_line));
  std::vector<Place> on_a_circle = random_places(30, 4);
  for (Place& place : on_a_circle) place.normalize();
  EXPECT_TRUE(is_given_up(on_a_circle));
  std::vector<Place> twice = random_places(30, 5);
  twice[3] = twice[17];
  EXPECT_TRUE(is_given_up(twice));
}

}  // namespace
}  // namespace meniscus
