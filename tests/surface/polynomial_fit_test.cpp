#include "meniscus/surface/polynomial_fit.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/surface/edge_interpolation.hpp"
#include "meniscus/surface/quartic_curvature.hpp"

namespace meniscus {
namespace {

TEST(Monomials, AreTaylorsInTheOrderOfTheirDegree) {
  const double u = 0.7, v = -1.3;
  const Eigen::Matrix<double, 14, 1> m = monomials<4>(u, v);
  int k = 0;
  for (int degree = 1; degree <= 4; ++degree)
    for (int j = 0; j <= degree; ++j, ++k) {
      const int i = degree - j;
      EXPECT_NEAR(m[k],
                  std::pow(u, i) * std::pow(v, j) / (std::tgamma(i + 1.0) * std::tgamma(j + 1.0)),
                  1e-15);
    }
  EXPECT_EQ(k, num_monomials(4));
  EXPECT_EQ((monomials<1>(u, v)), m.head<2>());
  EXPECT_EQ((monomials<2>(u, v)), m.head<5>());
  EXPECT_EQ((monomials<3>(u, v)), m.head<9>());
}

struct Point {
  double u, v;
};
std::vector<Point> random_points(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double u = uniform(random), v = uniform(random);
    points.push_back({u, v});
  }
  return points;
}

/// Polynomials of the degree are found from more points than terms, whatever the weights.
template <int Degree>
void expect_reproduction() {
  constexpr int kTerms = num_monomials(Degree);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Eigen::Matrix<double, kTerms, 1> exact;
    for (int k = 0; k < kTerms; ++k) exact[k] = std::cos(1.0 + k * seed);
    PolynomialFit<kTerms> fit;
    Eigen::Matrix<double, kTerms, 1> side = Eigen::Matrix<double, kTerms, 1>::Zero();
    for (const auto& [u, v] : random_points(3 * kTerms, seed)) {
      const auto m = monomials<Degree>(u, v);
      side += m.dot(exact) * fit.add(m, 1.0 / (u * u + v * v));
    }
    const auto factor = fit.factor();
    ASSERT_TRUE(factor) << "degree " << Degree << ", seed " << seed;
    EXPECT_LT((factor->solve(side) - exact).norm(), 1e-9)
        << "degree " << Degree << ", seed " << seed;
  }
}

TEST(PolynomialFit, ReproducesPolynomialsOfItsDegree) {
  expect_reproduction<1>();
  expect_reproduction<2>();
  expect_reproduction<3>();
  expect_reproduction<4>();
}

template <int Degree>
bool is_determined(const std::vector<Point>& points) {
  PolynomialFit<num_monomials(Degree)> fit;
  for (const auto& [u, v] : points) fit.add(monomials<Degree>(u, v), 1.0 / (u * u + v * v));
  return fit.factor().has_value();
}

TEST(PolynomialFit, IsRefusedWherePointsDoNotDetermineIt) {
  EXPECT_FALSE(is_determined<2>(random_points(4, 3)));
  EXPECT_FALSE(is_determined<4>(random_points(13, 3)));
  std::vector<Point> line, conic, ring;
  for (int i = 1; i <= 20; ++i) {
    line.push_back({0.1 * i, 0.3 * i});
    conic.push_back({0.1 * i, 0.01 * i * i});  // on v = u², which the fit cannot tell from zero
    const double angle = 0.1 * std::numbers::pi * i;
    ring.push_back({std::cos(angle), std::sin(angle)});
  }
  EXPECT_FALSE(is_determined<1>(line));
  EXPECT_FALSE(is_determined<2>(conic));
  EXPECT_TRUE(is_determined<2>(ring));   // u² + v² = 1 is no polynomial without a constant
  EXPECT_FALSE(is_determined<3>(ring));  // u (u² + v²) = u
}

// From the values at the ring the interpolation gives back any quadratic function of the tangent
// plane's coordinates.
TEST(VertexInterpolation, ReproducesQuadraticFunctions) {
  const SurfaceMesh mesh = stretched_sphere(200, Vec3(1.3, 0.8, 1.0));
  const SurfaceTopology topology(mesh);
  for (const VertexId v : mesh.x.ids()) {
    const Vec3 n = mesh.x[v].cwiseQuotient(Vec3(1.69, 0.64, 1.0)).normalized();
    const HeightPatch frame = flat_patch(mesh.x[v], n);
    const auto f = [&](const Vec3& x) {
      const double a = (x - frame.x).dot(frame.t1), b = (x - frame.x).dot(frame.t2);
      return 2.0 + 0.3 * a - 0.8 * b + 1.5 * a * a - 0.7 * a * b + 0.9 * b * b;
    };
    const VertexInterpolation interpolation(mesh, topology, v, n);
    Stencil stencil;
    const Vec3 at = mesh.x[v] + 0.05 * frame.t1 - 0.02 * frame.t2 + 0.01 * n;
    interpolation.add(at, 1.0, stencil);
    double value = 0.0, ones = 0.0;
    for (const VertexWeight& w : stencil) {
      value += w.weight * f(mesh.x[w.vertex]);
      ones += w.weight;
    }
    EXPECT_NEAR(value, f(at), 1e-13) << "vertex " << v.value;
    EXPECT_NEAR(ones, 1.0, 1e-14) << "vertex " << v.value;
  }
}

// g vanishes on the sphere, and with it the quartic.
TEST(QuarticCurvature, IsExactOnSpheres) {
  for (const int num_vertices : {60, 110, 400}) {
    const SurfaceMesh mesh = sphere(num_vertices, 2.0, Vec3(1.0, -2.0, 0.5));
    const SurfaceTopology topology(mesh);
    const auto osculating = osculating_curvature(mesh, topology);
    for (const VertexCurvature& c : quartic_curvature(mesh, topology, osculating)) {
      EXPECT_NEAR(c.k1, 0.5, 1e-9) << num_vertices;
      EXPECT_NEAR(c.k2, 0.5, 1e-9) << num_vertices;
    }
  }
}

}  // namespace
}  // namespace meniscus
