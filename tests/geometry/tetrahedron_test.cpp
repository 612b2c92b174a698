#include "meniscus/geometry/tetrahedron.hpp"

#include <random>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

/// Plain numbers, as kernels that work on several cells at a time use them.
struct Plain {
  double x = 0.0, y = 0.0, z = 0.0;
  friend Plain operator+(Plain a, Plain b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Plain operator-(Plain a, Plain b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Plain operator*(double s, Plain a) { return {s * a.x, s * a.y, s * a.z}; }
  friend double dot(Plain a, Plain b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Plain cross(Plain a, Plain b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

std::array<Vec3, 4> random_corners(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::array<Vec3, 4> x;
  for (Vec3& corner : x)
    for (double& coordinate : corner) coordinate = uniform(random);
  return x;
}

TEST(LinearTetrahedron, OfTheReferenceCorner) {
  const LinearTetrahedron tet = linear_tetrahedron(
      {Vec3(1, 2, 3), Vec3(3, 2, 3), Vec3(1, 6, 3), Vec3(1, 2, 11)});  // legs 2, 4, 8
  EXPECT_DOUBLE_EQ(tet.volume, 64.0 / 6.0);
  EXPECT_EQ(tet.gradient[1], Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(tet.gradient[2], Vec3(0.0, 0.25, 0.0));
  EXPECT_EQ(tet.gradient[3], Vec3(0.0, 0.0, 0.125));
  EXPECT_EQ(tet.gradient[0], Vec3(-0.5, -0.25, -0.125));
}

// b_i is 1 at corner i and 0 at the others, so that g_i·(x_j − x_k) = δ_ij − δ_ik: it is enough to
// know every linear function. Errors are those of the determinant, relative to it.
TEST(LinearTetrahedron, GradientsAreThoseOfTheBarycentricCoordinates) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const std::array<Vec3, 4> x = random_corners(seed);
    const LinearTetrahedron tet = linear_tetrahedron(x);
    const double tolerance = 1e-14 / std::abs(tet.volume);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      sum += tet.gradient[i];
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k)
          EXPECT_NEAR(tet.gradient[i].dot(x[j] - x[k]), double(i == j) - double(i == k), tolerance)
              << "seed " << seed;
    }
    EXPECT_LT(sum.norm(), tolerance) << "seed " << seed;
    EXPECT_NEAR(tet.volume, (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6.0, 1e-15);
    EXPECT_NEAR(linear_tetrahedron({x[1], x[0], x[2], x[3]}).volume, -tet.volume, 1e-15);
  }
}

TEST(LinearTetrahedron, IsTheSameOfPlainNumbers) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::array<Vec3, 4> x = random_corners(seed);
    std::array<Plain, 4> plain;
    for (std::size_t k = 0; k < 4; ++k) plain[k] = {x[k].x(), x[k].y(), x[k].z()};
    const LinearTetrahedron tet = linear_tetrahedron(x);
    const BarycentricTetrahedron<Plain> same = linear_tetrahedron(plain);
    const double tolerance = 1e-14 / std::abs(tet.volume);
    EXPECT_NEAR(same.volume, tet.volume, 1e-15) << "seed " << seed;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(same.gradient[k].x, tet.gradient[k].x(), tolerance) << "seed " << seed;
      EXPECT_NEAR(same.gradient[k].y, tet.gradient[k].y(), tolerance) << "seed " << seed;
      EXPECT_NEAR(same.gradient[k].z, tet.gradient[k].z(), tolerance) << "seed " << seed;
    }
  }
}

TEST(BarycentricCoordinates, GiveThePointBack) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const std::array<Vec3, 4> x = random_corners(seed);
    const Vec3 p = random_corners(seed + 1000)[0];
    const std::array<double, 4> b = barycentric_coordinates(x, p);
    const double tolerance = 1e-14 / std::abs(linear_tetrahedron(x).volume);
    EXPECT_NEAR(b[0] + b[1] + b[2] + b[3], 1.0, tolerance) << "seed " << seed;
    EXPECT_LT((b[0] * x[0] + b[1] * x[1] + b[2] * x[2] + b[3] * x[3] - p).norm(), tolerance)
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace meniscus
