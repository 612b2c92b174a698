#include "meniscus/geometry/quadratic_triangle.hpp"

#include <random>

#include <gtest/gtest.h>

#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/geometry/triangle.hpp"

namespace meniscus {
namespace {

using Barycentric = std::array<double, 3>;

// Corners, then the middles of the edges 01, 12, 20.
constexpr std::array<Barycentric, 6> kNodes = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}};

TEST(QuadraticTriangle, FunctionsAreOneAtTheirNodes) {
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_EQ(quadratic_values(kNodes[j])[i], i == j ? 1.0 : 0.0);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_EQ(linear_shape(kNodes[j]).value[i], i == j ? 1.0 : 0.0);
}

template <std::size_t Nodes>
double sum(const std::array<double, Nodes>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

TEST(QuadraticTriangle, FunctionsAddUpToOne) {
  for (const auto& [b, share] : kTriangleRule6) {
    const TriangleShape<6> quadratic = quadratic_shape(b);
    EXPECT_NEAR(sum(quadratic.value), 1.0, 1e-15);
    EXPECT_NEAR(sum(quadratic.by_1), 0.0, 1e-15);
    EXPECT_NEAR(sum(quadratic.by_2), 0.0, 1e-15);
    EXPECT_EQ(quadratic.value, quadratic_values(b));
    const TriangleShape<3> linear = linear_shape(b);
    EXPECT_NEAR(sum(linear.value), 1.0, 1e-15);
    EXPECT_EQ(sum(linear.by_1) + sum(linear.by_2), 0.0);
  }
}

// Central differences of quadratic functions are exact, to the round-off of 1/step.
TEST(QuadraticTriangle, DerivativesAreDifferences) {
  constexpr double kStep = 0.01;
  for (const auto& [b, share] : kTriangleRule6) {
    const TriangleShape<6> shape = quadratic_shape(b);
    const auto difference = [&](std::size_t corner, std::size_t i) {
      Barycentric up = b, down = b;
      up[corner] += kStep, up[0] -= kStep;
      down[corner] -= kStep, down[0] += kStep;
      return (quadratic_values(up)[i] - quadratic_values(down)[i]) / (2.0 * kStep);
    };
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(shape.by_1[i], difference(1, i), 1e-13);
      EXPECT_NEAR(shape.by_2[i], difference(2, i), 1e-13);
    }
  }
}

class RandomFace : public testing::Test {
 protected:
  RandomFace() {
    std::uniform_real_distribution<double> uniform(-0.2, 0.2);
    for (std::size_t i = 0; i < 6; ++i) {
      const double u = uniform(random_), v = uniform(random_), w = uniform(random_);
      x_[i] = Vec3(kNodes[i][1], kNodes[i][2], 0.3) + Vec3(u, v, w);
    }
  }
  std::mt19937 random_{11};
  TriangleNodes<6> x_;
};

TEST_F(RandomFace, GradientsAreDualToTheTangents) {
  for (const auto& [b, share] : kTriangleRule6) {
    const TriangleTangents at = tangents(quadratic_shape(b), x_);
    const auto [g1, g2] = surface_gradients(at);
    EXPECT_NEAR(g1.dot(at.t1), 1.0, 1e-13);
    EXPECT_NEAR(g2.dot(at.t2), 1.0, 1e-13);
    EXPECT_NEAR(g1.dot(at.t2), 0.0, 1e-13);
    EXPECT_NEAR(g2.dot(at.t1), 0.0, 1e-13);
    EXPECT_NEAR(g1.dot(at.area()), 0.0, 1e-14);
    EXPECT_NEAR(g2.dot(at.area()), 0.0, 1e-14);
  }
}

// Any linear function of position has on the face the tangential part of its gradient.
TEST_F(RandomFace, GradientsReproduceLinearFunctions) {
  const Vec3 gradient(0.3, -1.2, 0.7);
  for (const auto& [b, share] : kTriangleRule6) {
    const TriangleShape<6> shape = quadratic_shape(b);
    const TriangleTangents at = tangents(shape, x_);
    const auto [g1, g2] = surface_gradients(at);
    Vec3 found = Vec3::Zero();
    for (std::size_t i = 0; i < 6; ++i)
      found += gradient.dot(x_[i]) * (shape.by_1[i] * g1 + shape.by_2[i] * g2);
    const Vec3 n = at.area().normalized();
    EXPECT_LT((found - (gradient - gradient.dot(n) * n)).norm(), 1e-13);
  }
}

// The area vector of a face depends on its rim alone: ½∮ x × dx, Simpson's rule on each edge being
// exact for its cubic integrand.
TEST_F(RandomFace, AreaVectorIsThatOfItsRim) {
  Vec3 sum = Vec3::Zero(), rim = Vec3::Zero();
  for (const auto& [b, share] : kTriangleRule4)
    sum += share * tangents(quadratic_shape(b), x_).area();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = x_[k], &m = x_[3 + k], &c = x_[(k + 1) % 3];
    const Vec3 at_a = 4.0 * m - 3.0 * a - c, at_m = c - a, at_c = 3.0 * c - 4.0 * m + a;
    rim += 0.5 / 6.0 * (a.cross(at_a) + 4.0 * m.cross(at_m) + c.cross(at_c));
  }
  EXPECT_LT((sum - rim).norm(), 1e-14);
}

TEST_F(RandomFace, IsStraightWhereItsMiddlesAre) {
  for (std::size_t k = 0; k < 3; ++k) x_[3 + k] = 0.5 * (x_[k] + x_[(k + 1) % 3]);
  const TriangleNodes<3> corners{x_[0], x_[1], x_[2]};
  for (const auto& [b, share] : kTriangleRule6) {
    const TriangleTangents quadratic = tangents(quadratic_shape(b), x_),
                           linear = tangents(linear_shape(b), corners);
    EXPECT_LT((quadratic.t1 - linear.t1).norm(), 1e-15);
    EXPECT_LT((quadratic.t2 - linear.t2).norm(), 1e-15);
    EXPECT_LT((weighted_sum(quadratic_values(b), x_) - weighted_sum(b, corners)).norm(), 1e-15);
    EXPECT_LT((linear.area() - 0.5 * (x_[1] - x_[0]).cross(x_[2] - x_[0])).norm(), 1e-16);
  }
}

}  // namespace
}  // namespace meniscus
