#include "meniscus/surface/curvature.hpp"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

using test::ellipsoid_curvature;
using test::observed_order;

template <class Exact>
double largest_error(const SurfaceMesh& mesh, const VertexField<VertexCurvature>& fit,
                     const Exact& exact) {
  double error = 0.0;
  for (const VertexId v : mesh.x.ids())
    error = std::max(error, std::abs(fit[v].sum() - exact(mesh.x[v]).sum));
  return error;
}

TEST(FittedCurvature, SphereErrorIsWithinTheMeasuredOnes) {
  // Largest error of κ (of 2) of one-ring paraboloids without weights on Lloyd-relaxed spheres,
  // measured with an independent program.
  const std::array<std::pair<int, double>, 3> measured{
      {{500, 4.7e-2}, {1000, 2.3e-2}, {5000, 5e-3}}};
  for (const auto& [n, bound] : measured) {
    const SurfaceMesh mesh = sphere(n);
    const auto fit = fitted_curvature(mesh, SurfaceTopology(mesh));
    EXPECT_LT(largest_error(mesh, fit,
                            [](const Vec3& x) { return ellipsoid_curvature(x, Vec3::Ones()); }),
              bound)
        << n;
  }
}

TEST(FittedCurvature, IsSecondOrderOnAnEllipsoid) {
  // In the mean: at the few vertices of valence 5 and 7 a ring has odd parts, and the error is
  // between first and second order.
  const Vec3 axes(1.5, 1.0, 0.8);
  std::vector<double> vertices, errors, independent_errors, normal_errors;
  for (const int n : {250, 500, 1000, 2000, 4000}) {
    const SurfaceMesh mesh = test::equilibrated_ellipsoid(n, axes);
    const SurfaceTopology topology(mesh);
    const auto fit = fitted_curvature(mesh, topology);
    const auto independent = osculating_curvature(mesh, topology);
    double error = 0.0, independent_error = 0.0, normal_error = 0.0;
    for (const VertexId v : mesh.x.ids()) {
      const auto exact = ellipsoid_curvature(mesh.x[v], axes);
      error += std::pow(fit[v].sum() - exact.sum, 2);
      independent_error += std::pow(independent[v].sum() - exact.sum, 2);
      normal_error += (fit[v].n - exact.n).squaredNorm();
    }
    vertices.push_back(mesh.num_vertices());
    errors.push_back(std::sqrt(error / mesh.num_vertices()));
    independent_errors.push_back(std::sqrt(independent_error / mesh.num_vertices()));
    normal_errors.push_back(std::sqrt(normal_error / mesh.num_vertices()));
  }
  EXPECT_GT(observed_order(vertices, errors), 1.8);
  EXPECT_GT(observed_order(vertices, independent_errors), 1.8);
  EXPECT_GT(observed_order(vertices, normal_errors), 1.8);
}

TEST(FittedCurvature, IsSecondOrderOnATorus) {
  std::vector<double> vertices, errors, independent_errors;
  for (const int rows : {16, 24, 32, 48}) {
    const SurfaceMesh mesh = test::torus(5 * rows / 2, rows, 1.0, 0.4);
    const SurfaceTopology topology(mesh);
    const auto exact = [](const Vec3& x) { return test::torus_curvature(x, 1.0, 0.4); };
    vertices.push_back(mesh.num_vertices());
    errors.push_back(largest_error(mesh, fitted_curvature(mesh, topology), exact));
    independent_errors.push_back(largest_error(mesh, osculating_curvature(mesh, topology), exact));
  }
  EXPECT_GT(observed_order(vertices, errors), 1.8);
  EXPECT_GT(observed_order(vertices, independent_errors), 1.8);
}

TEST(FittedCurvature, PrincipalCurvaturesAndDirectionsOfATorus) {
  const double major = 1.0, minor = 0.4;
  const SurfaceMesh mesh = test::torus(150, 60, major, minor);
  const auto fit = fitted_curvature(mesh, SurfaceTopology(mesh));
  for (const VertexId v : mesh.x.ids()) {
    const Vec3& x = mesh.x[v];
    const double rho = std::hypot(x.x(), x.y());
    const double along = (rho - major) / (minor * rho);
    EXPECT_NEAR(fit[v].k1, 1.0 / minor, 0.01 / minor);  // h²/8r² of the arc h = 2πr/60 is 0.0014
    EXPECT_NEAR(fit[v].k2, along, 0.03);
    EXPECT_LT(std::abs(fit[v].d2.z()), 0.02);  // d2 circles the axis
    EXPECT_NEAR(fit[v].d1.cross(fit[v].d2).dot(fit[v].n), 1.0, 1e-12);
  }
}

TEST(FittedCurvature, LowValencesAreNotSingular) {
  // Tetrahedron, octahedron and a vertex of valence 3 put into each face of an icosahedron.
  SurfaceMesh tetrahedron;
  for (const Vec3& x : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
    tetrahedron.x.add(x.normalized());
  for (const FaceVertices& f : {FaceVertices{VertexId{0}, VertexId{1}, VertexId{2}},
                                {VertexId{0}, VertexId{2}, VertexId{3}},
                                {VertexId{0}, VertexId{3}, VertexId{1}},
                                {VertexId{1}, VertexId{3}, VertexId{2}}})
    tetrahedron.faces.add(f);
  SurfaceMesh starred = sphere(12);
  const FaceField<FaceVertices> faces = starred.faces;
  starred.faces = {};
  for (const FaceVertices& f : faces) {
    const VertexId m =
        starred.x.add((starred.x[f[0]] + starred.x[f[1]] + starred.x[f[2]]).normalized());
    for (std::size_t k = 0; k < 3; ++k) starred.faces.add({f[k], f[(k + 1) % 3], m});
  }
  for (const SurfaceMesh& mesh : {tetrahedron, starred, sphere(12), sphere(20)}) {
    const SurfaceTopology topology(mesh);
    const auto fit = fitted_curvature(mesh, topology);
    const auto independent = osculating_curvature(mesh, topology);
    for (const VertexId v : mesh.x.ids()) {
      double farthest = 0.0;
      for (const VertexId w : topology.ring(v))
        farthest = std::max(farthest, (mesh.x[w] - mesh.x[v]).squaredNorm());
      // A parabola through a point of the unit circle at distance d has the curvature 1/(1 − d²/4).
      // Second rings, taken at valences below five, are up to √3 times as far.
      const double reach = topology.valence(v) >= 5 || mesh.num_vertices() == 4 ? 1.0 : 3.0;
      EXPECT_GT(fit[v].n.dot(mesh.x[v]), 0.9);  // edges as long as the radius
      EXPECT_GT(fit[v].sum(), 2.0);
      EXPECT_LT(fit[v].sum(), 2.0 / (1.0 - reach * farthest / 4.0) + 1e-9) << v.value;
      EXPECT_NEAR(independent[v].sum(), 2.0, 1e-9);
    }
  }
}

TEST(OsculatingCurvature, IsExactOnSpheres) {
  for (const int n : {42, 110, 1000}) {
    const SurfaceMesh mesh = sphere(n, 0.3, Vec3(5, -2, 1));
    const auto fit = osculating_curvature(mesh, SurfaceTopology(mesh));
    for (const VertexId v : mesh.x.ids()) {
      EXPECT_NEAR(fit[v].k1, 1.0 / 0.3, 1e-8);
      EXPECT_NEAR(fit[v].k2, 1.0 / 0.3, 1e-8);
    }
  }
}

TEST(FittedCurvature, TurnsWithTheSurface) {
  SurfaceMesh mesh = test::bumpy_sphere(300, 7, 0.4);
  const auto before = fitted_curvature(mesh, SurfaceTopology(mesh));
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& x : mesh.x) x = turn * x + Vec3(3, 0, -1);
  const auto after = fitted_curvature(mesh, SurfaceTopology(mesh));
  for (const VertexId v : mesh.x.ids()) {
    EXPECT_LT((after[v].n - turn * before[v].n).norm(), 1e-9);
    EXPECT_NEAR(after[v].k1, before[v].k1, 1e-8);
    EXPECT_NEAR(after[v].k2, before[v].k2, 1e-8);
  }
}

}  // namespace
}  // namespace meniscus
