#include "meniscus/surface/sizing.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/constants.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

VertexField<double> lengths(const SurfaceMesh& mesh, const RemeshOptions& options) {
  const SurfaceTopology topology(mesh);
  return rest_lengths(mesh, topology, SmoothSurface(mesh, topology), options);
}

TEST(RestLengths, SphereAsksForItsNodes) {
  // N0 equilateral triangles' worth of area: l0² = 2/(√3 C0⟨κ⟩²), C0 = N0/4π.
  const double C0 = 200 / (4.0 * std::numbers::pi);
  const double exact = std::sqrt(2.0 / (std::numbers::sqrt3 * C0));
  for (const double radius : {1.0, 0.25})
    for (const double l : lengths(sphere(300, radius), {.C0 = C0}))
      EXPECT_NEAR(l, radius * exact, 1e-9 * radius);
  EXPECT_DOUBLE_EQ(density_of_length(length_of_density(3.7)), 3.7);
}

TEST(RestLengths, AThreadHasItsEdgesAround) {
  const double C0 = 110 / (4.0 * std::numbers::pi);
  // At the waist of a prolate ellipsoid of axes a, 1, 1 the curvatures are 1 and 1/a².
  const SurfaceMesh thread = stretched_sphere(4000, Vec3(6, 1, 1));
  const auto plain = lengths(thread, {.C0 = C0}),
             bounded = lengths(thread, {.C0 = C0, .neck_edges = 15.0}),
             few = lengths(thread, {.C0 = C0, .neck_edges = 8.0});
  int at_waist = 0, at_tips = 0;
  for (const VertexId v : thread.x.ids()) {
    EXPECT_LE(bounded[v], plain[v]);
    if (std::abs(thread.x[v].x()) < 4.0) {
      EXPECT_DOUBLE_EQ(few[v], plain[v]);  // a cylinder has 12.2 of its own
    }
    if (std::abs(thread.x[v].x()) < 0.3) {
      ++at_waist;
      EXPECT_NEAR(2.0 * std::numbers::pi / plain[v], 12.2, 0.1);
      // w = 1 − 4/a² to the second order in 1/a².
      EXPECT_NEAR(2.0 * std::numbers::pi / bounded[v], 15.0 * std::pow(12.2 / 15.0, 4.0 / 36.0),
                  0.1);
    }
    if (std::abs(thread.x[v].x()) > 5.98) {
      ++at_tips;
      EXPECT_DOUBLE_EQ(bounded[v], plain[v]);
    }
  }
  const SurfaceTopology topology(thread);
  for (const SurfaceEdge& e : topology.edges()) {
    EXPECT_LE(std::abs(bounded[e.a] - bounded[e.b]),
              kNeckGradation * (thread.x[e.a] - thread.x[e.b]).norm() * (1.0 + 1e-9));
  }
  EXPECT_GT(at_waist, 50);
  EXPECT_GT(at_tips, 3);
  const SurfaceMesh ball = sphere(300);
  EXPECT_EQ(lengths(ball, {.C0 = C0, .neck_edges = 30.0}), lengths(ball, {.C0 = C0}));
}

TEST(RestLengths, ObeyFloorCeilingAndBound) {
  const SurfaceMesh mesh = stretched_sphere(500, Vec3(3, 1, 1));
  const auto plain = lengths(mesh, {.C0 = 40.0});
  const auto limited = lengths(mesh, {.C0 = 40.0, .edge_floor = 0.07, .edge_ceiling = 0.15});
  for (const VertexId v : mesh.x.ids()) {
    EXPECT_GE(limited[v], 0.07);
    EXPECT_LE(limited[v], 0.15);
    if (plain[v] > 0.08 && plain[v] < 0.14) {
      EXPECT_DOUBLE_EQ(limited[v], plain[v]);
    }
  }
  const auto bound = [](const Vec3& x) { return 0.05 + 0.1 * std::abs(x.x()); };
  const auto bounded = lengths(mesh, {.C0 = 40.0, .size_bound = bound});
  for (const VertexId v : mesh.x.ids()) EXPECT_LE(bounded[v], bound(mesh.x[v]));
}

TEST(RestLengths, GradationIsLimitedAlongEveryEdge) {
  const SurfaceMesh mesh = sphere(2000);
  const auto bound = [](const Vec3& x) { return (x - Vec3(1, 0, 0)).norm() < 0.2 ? 0.01 : 1.0; };
  const SurfaceTopology topology(mesh);
  for (const double gradation : {0.1, 0.3}) {
    const auto l = lengths(mesh, {.C0 = 10.0, .gradation = gradation, .size_bound = bound});
    for (const SurfaceEdge& e : topology.edges())
      EXPECT_LE(std::abs(l[e.a] - l[e.b]),
                gradation * (mesh.x[e.a] - mesh.x[e.b]).norm() * (1.0 + 1e-9));
    // Far from the spot the length is untouched.
    EXPECT_GT(*std::ranges::max_element(l), 0.2);
  }
}

TEST(RestLengths, FewVerticesAreMadeEnough) {
  const SurfaceMesh mesh = stretched_sphere(400, Vec3(1.5, 1, 1));
  const auto area = vertex_areas(mesh);
  const auto expected = [&](const RemeshOptions& options) {
    const auto l = lengths(mesh, options);
    double sum = 0.0;
    for (const VertexId v : mesh.x.ids()) sum += area[v] * density_of_length(l[v]);
    return sum;
  };
  // Averaging over rings of unequal size moves the integral by under one per cent.
  EXPECT_NEAR(expected({.C0 = 0.1, .gradation = 1e3, .min_vertices = 70}), 70.0, 0.7);
  // A floor as long as the drop would leave it two vertices.
  EXPECT_NEAR(expected({.C0 = 0.1, .edge_floor = 2.0, .min_vertices = 70}), 70.0, 0.7);
}

}  // namespace
}  // namespace meniscus
