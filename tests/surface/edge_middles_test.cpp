#include "meniscus/surface/edge_middles.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/smooth_surface.hpp"
#include "tests/surface/shapes.hpp"

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
    for (const Vec3& x : middles_on_splines(mesh, SurfaceTopology(mesh)))
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
    errors.push_back(largest_error(middles_on_splines(mesh, topology)));
    const SmoothSurface smooth(mesh, topology);
    std::vector<Vec3> cubic;
    for (const SurfaceEdge& edge : topology.edges())
      cubic.push_back(smooth.edge_point(edge.a, edge.b, 0.5));
    EXPECT_LT(errors.back(), 0.4 * largest_error(cubic)) << num_vertices;
  }
  // Above the fourth order in h ~ N^(−1/2) that the cubic patches have.
  EXPECT_GT(2.0 * std::log(errors.front() / errors.back()) / std::log(4.0), 4.5);
}

/// Largest distance of the middles from a torus with so many edges around its tube of radius 1.
double largest_error_on_torus(int edges_around) {
  constexpr double kMajor = 4.0;
  const SurfaceMesh mesh =
      test::torus(static_cast<int>(kMajor * edges_around), edges_around, kMajor, 1.0);
  double largest = 0.0;
  for (const Vec3& x : middles_on_splines(mesh, SurfaceTopology(mesh))) {
    const double from_tube = std::hypot(std::hypot(x.x(), x.y()) - kMajor, x.z());
    largest = std::max(largest, std::abs(from_tube - 1.0));
  }
  return largest;
}

// A tube differs much from the sphere of its mean curvature, whose levels in place of the quadric's
// make errors of 0.037, 6.7e-3, 1.2e-3 and 1.7e-4.
TEST(EdgeMiddles, LieOnTubesOfFewEdges) {
  for (const auto& [edges, most] :
       {std::pair(10, 4e-3), std::pair(12, 8e-4), std::pair(15, 4e-4), std::pair(20, 6e-5)})
    EXPECT_LT(largest_error_on_torus(edges), most) << edges;
}

/// Largest distance between the middles of two meshes of one topology.
double largest_move(const SurfaceMesh& a, const SurfaceMesh& b) {
  const SurfaceTopology topology(a);
  const std::vector<Vec3> from = middles_on_splines(a, topology),
                          to = middles_on_splines(b, topology);
  double largest = 0.0;
  for (std::size_t e = 0; e < from.size(); ++e)
    largest = std::max(largest, (to[e] - from[e]).norm());
  return largest;
}

// A coarse mesh whose vertices leave the sphere, down to the pair of instants between which its
// middles move the most: they must not jump, or no shift restores the volume under them. With the
// spline given up at once where it amplifies too much, a middle of this mesh jumped by 0.3.
TEST(EdgeMiddles, FollowTheVerticesWithoutJumps) {
  constexpr unsigned kSeed = 5;
  const SurfaceMesh even = sphere(59);
  SurfaceMesh rough = even;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> noise(-0.15, 0.15);
  for (Vec3& x : rough.x) x += Vec3(noise(random), noise(random), noise(random));
  const auto at = [&](double s) {
    SurfaceMesh mesh = even;
    for (const VertexId v : mesh.x.ids()) mesh.x[v] += s * (rough.x[v] - even.x[v]);
    return mesh;
  };
  constexpr int kSteps = 40, kHalvings = 14;
  double begin = 0.0, length = 1.0 / kSteps, most = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = i / double(kSteps), move = largest_move(at(s), at(s + length));
    if (move > most) begin = s;
    most = std::max(most, move);
  }
  for (int i = 0; i < kHalvings; ++i) {
    length *= 0.5;
    if (largest_move(at(begin), at(begin + length)) <
        largest_move(at(begin + length), at(begin + 2.0 * length)))
      begin += length;
  }
  // 1.5e-6 of the way, on which no vertex moves by more than 4e-7.
  EXPECT_LT(largest_move(at(begin), at(begin + length)), 1e-4) << "seed " << kSeed;
}

// Vertices thrown about by up to two thirds of an edge leave creases that no fit can follow.
TEST(EdgeMiddles, StayNearTheirEdgesOnCrumpledSurfaces) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.2, 0.2);
    SurfaceMesh mesh = sphere(80);
    for (Vec3& x : mesh.x) x += Vec3(noise(random), noise(random), noise(random));
    const SurfaceTopology topology(mesh);
    const SmoothSurface smooth(mesh, topology);
    const std::vector<Vec3> middles = middles_on_splines(mesh, topology);
    for (std::size_t e = 0; e < middles.size(); ++e) {
      const auto& [a, b] = std::pair(topology.edges()[e].a, topology.edges()[e].b);
      const Vec3 straight = 0.5 * (mesh.x[a] + mesh.x[b]);
      const double most = 0.6 * (mesh.x[b] - mesh.x[a]).norm();
      EXPECT_LT((smooth.edge_point(a, b, 0.5) - straight).norm(), most) << "seed " << seed;
      EXPECT_LT((middles[e] - straight).norm(), most) << "seed " << seed;
    }
  }
}

// Seen from a vertex 1e20 away all others are in one place, which determines no spline.
TEST(EdgeMiddles, AreFiniteWhereAVertexIsFarAway) {
  SurfaceMesh mesh = sphere(66);
  mesh.x[VertexId{2}].x() = 1e20;
  for (const Vec3& x : middles_on_splines(mesh, SurfaceTopology(mesh))) EXPECT_TRUE(x.allFinite());
}

}  // namespace
}  // namespace meniscus
