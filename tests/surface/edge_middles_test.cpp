#include "meniscus/surface/edge_middles.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curved_measures.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {
namespace {

/// r = 1 + ε P4(cos θ), with the angle to the x-axis.
double radius(const Vec3& x) {
  const double c = x.normalized().x(), cc = c * c;
  return 1.0 + 0.02 * (35.0 * cc * cc - 30.0 * cc + 3.0) / 8.0;
}

SurfaceMesh wavy_sphere(int num_vertices) {
  SurfaceMesh mesh = sphere(num_vertices);
  for (Vec3& x : mesh.x) x *= radius(x);
  return mesh;
}

double largest_error(const std::vector<Vec3>& points) {
  double largest = 0.0;
  for (const Vec3& x : points) largest = std::max(largest, std::abs(x.norm() - radius(x)));
  return largest;
}

TEST(EdgeMiddles, AreExactOnSpheres) {
  for (const int num_vertices : {42, 110, 400}) {
    const SurfaceMesh mesh = sphere(num_vertices, 2.0, Vec3(3.0, -1.0, 0.5));
    for (const Vec3& x : edge_middles(mesh, SurfaceTopology(mesh)))
      // What the smooth surface's own point leaves, O(h⁶), where the rings are too poor; else
      // roundoff of the splines' weights.
      EXPECT_NEAR((x - Vec3(3.0, -1.0, 0.5)).norm(), 2.0, num_vertices == 42 ? 2e-3 : 1e-4);
  }
}

// Measured on these meshes: a ninth of the cubic patches' largest error at 200 vertices, a
// twentieth at 400.
TEST(EdgeMiddles, AreOfHigherOrderThanTheCubicPatches) {
  std::vector<double> errors;
  for (const int num_vertices : {200, 400, 800}) {
    const SurfaceMesh mesh = wavy_sphere(num_vertices);
    const SurfaceTopology topology(mesh);
    errors.push_back(largest_error(edge_middles(mesh, topology)));
    const SmoothSurface smooth(mesh, topology);
    std::vector<Vec3> cubic;
    for (const SurfaceEdge& edge : topology.edges())
      cubic.push_back(smooth.edge_point(edge.a, edge.b, 0.5));
    EXPECT_LT(errors.back(), 0.4 * largest_error(cubic)) << num_vertices;
  }
  // Above the fourth order in h ~ N^(−1/2) that the cubic patches have.
  EXPECT_GT(2.0 * std::log(errors.front() / errors.back()) / std::log(4.0), 4.5);
}

TEST(CurvedMeasures, AreThoseOfTheSmoothSurface) {
  std::vector<double> errors;
  for (const int num_vertices : {110, 220, 440}) {
    const CurvedMeasures ball = curved_measures(sphere(num_vertices, 1.5, Vec3(10.0, 0.0, 0.0)));
    const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(1.5, 3);
    errors.push_back(std::abs(ball.volume / exact - 1.0));
    EXPECT_NEAR(ball.area, 4.0 * std::numbers::pi * 2.25, 3.0 * errors.back() * ball.area + 1e-3);
  }
  // Parabolic faces leave O(h⁴); flat ones 5.4/N of the volume, 5e-2 here.
  EXPECT_LT(errors.front(), 1e-3);
  EXPECT_GT(2.0 * std::log(errors.front() / errors.back()) / std::log(4.0), 3.5);
}

TEST(CurvedMeasures, VolumeIsRestoredByAShift) {
  SurfaceMesh mesh = wavy_sphere(150);
  const double volume = 1.02 * curved_measures(mesh).volume;
  const double shift = restore_curved_volume(mesh, volume);
  EXPECT_NEAR(curved_measures(mesh).volume, volume, 2e-12 * volume);
  EXPECT_NEAR(shift, 0.02 / 3.0, 1e-3);
}

TEST(CurvedMeasures, NormalsAreThoseOfTheSurface) {
  const SurfaceMesh mesh = stretched_sphere(400, Vec3(1.3, 0.9, 0.8));
  const VertexField<Vec3> n = smooth_normals(mesh);
  for (const VertexId v : mesh.x.ids()) {
    const Vec3 exact = mesh.x[v].cwiseQuotient(Vec3(1.69, 0.81, 0.64)).normalized();
    EXPECT_LT((n[v] - exact).norm(), 5e-3);
  }
}

}  // namespace
}  // namespace meniscus
