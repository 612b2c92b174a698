#include "meniscus/surface/smooth_surface.hpp"

#include <gtest/gtest.h>

#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/surface_walk.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

using test::observed_order;

const std::array<Vec3, 4> kPlaces{Vec3(1, 1, 1) / 3.0, Vec3(0.5, 0.5, 0), Vec3(0.7, 0.1, 0.2),
                                  Vec3(0.05, 0.25, 0.7)};

TEST(SmoothSurface, ConvergesOnAnEllipsoid) {
  const Vec3 axes(1.5, 1.0, 0.8);
  std::vector<double> vertices, largest, position, normal;
  for (const int n : {500, 1000, 2000, 4000}) {
    const SurfaceMesh mesh = test::equilibrated_ellipsoid(n, axes);
    const SmoothSurface surface(mesh, SurfaceTopology(mesh));
    double farthest = 0.0, distance = 0.0, tilt = 0.0;
    for (const FaceId f : mesh.faces.ids())
      for (const Vec3& weights : kPlaces) {
        const auto [x, n_there] = surface.at({f, weights});
        const auto exact = test::ellipsoid_curvature(x, axes);
        const double d = test::ellipsoid_distance(x, axes);
        farthest = std::max(farthest, std::abs(d));
        distance += d * d;
        tilt += (n_there - exact.n).squaredNorm();
      }
    const double count = 4.0 * mesh.num_faces();
    vertices.push_back(mesh.num_vertices());
    largest.push_back(farthest);
    position.push_back(std::sqrt(distance / count));
    normal.push_back(std::sqrt(tilt / count));
  }
  EXPECT_GT(observed_order(vertices, largest), 3.0);
  EXPECT_GT(observed_order(vertices, position), 3.8);
  EXPECT_GT(observed_order(vertices, normal), 2.8);
}

TEST(SmoothSurface, ConvergesOnATorusMadeByRemeshing) {
  // A fitted, irregular mesh: its vertices lie on surfaces fitted to coarser vertices' neighbours.
  const double major = 1.0, minor = 0.4;
  std::vector<double> vertices, position;
  for (const double C0 : {15.0, 30.0, 60.0, 120.0}) {
    SurfaceMesh mesh = test::torus(160, 64, major, minor);
    ASSERT_TRUE(remesh(mesh, {.C0 = C0}).ok());
    // Onto the torus again, so that only this fit is measured.
    for (Vec3& x : mesh.x) {
      const Vec3 n = test::torus_curvature(x, major, minor).n.normalized();
      const double rho = std::hypot(x.x(), x.y());
      x = Vec3(major * x.x() / rho, major * x.y() / rho, 0.0) + minor * n;
    }
    const SmoothSurface surface(mesh, SurfaceTopology(mesh));
    double error = 0.0;
    for (const FaceId f : mesh.faces.ids())
      for (const Vec3& weights : kPlaces) {
        const Vec3 x = surface.point(f, weights);
        error =
            std::max(error, std::abs(std::hypot(std::hypot(x.x(), x.y()) - major, x.z()) - minor));
      }
    vertices.push_back(mesh.num_vertices());
    position.push_back(error);
  }
  EXPECT_GT(observed_order(vertices, position), 3.0);
}

TEST(SmoothSurface, PassesThroughVerticesAndJoinsAcrossEdges) {
  const SurfaceMesh mesh = test::bumpy_sphere(400, 3, 0.5);
  const SurfaceTopology topology(mesh);
  const SmoothSurface surface(mesh, topology);
  for (const FaceId f : mesh.faces.ids())
    for (int k = 0; k < 3; ++k)
      EXPECT_LT((surface.point(f, Vec3::Unit(k)) - mesh.x[mesh.faces[f][std::size_t(k)]]).norm(),
                1e-14);
  const auto at_corners = [&](FaceId f, VertexId a, VertexId b, double s) {
    Vec3 weights = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      if (mesh.faces[f][std::size_t(k)] == a) weights[k] = 1.0 - s;
      if (mesh.faces[f][std::size_t(k)] == b) weights[k] = s;
    }
    return SurfacePoint{f, weights};
  };
  for (const SurfaceEdge& e : topology.edges())
    for (const double s : {0.25, 0.5, 0.9}) {
      const Vec3 x = surface.edge_point(e.a, e.b, s);
      const auto left = surface.at(at_corners(e.left, e.a, e.b, s));
      const auto right = surface.at(at_corners(e.right, e.a, e.b, s));
      EXPECT_LT((left.x - x).norm(), 1e-14);
      EXPECT_LT((right.x - x).norm(), 1e-14);
      EXPECT_LT((left.n - right.n).norm(), 1e-13);
    }
}

TEST(SmoothSurface, IsASphereWhereTheMeshIs) {
  // Heights are those of circles to the sixth order of the distance from the vertex over the
  // radius: at 110 vertices the longest edge is 0.45, its flat points up to 0.26 away, and 0.26⁶/16
  // is 2e-5.
  const SurfaceMesh mesh = sphere(110);
  const SmoothSurface surface(mesh, SurfaceTopology(mesh));
  for (const FaceId f : mesh.faces.ids())
    for (const Vec3& weights : kPlaces) EXPECT_NEAR(surface.point(f, weights).norm(), 1.0, 2e-5);
  for (const VertexId v : mesh.x.ids()) EXPECT_NEAR(surface.patch(v).curvature().k1, 1.0, 1e-9);
}

TEST(SurfaceWalk, ReachesWhatLiesBelowTheTarget) {
  const SurfaceMesh mesh = sphere(500);
  const SurfaceTopology topology(mesh);
  const SmoothSurface surface(mesh, topology);
  const SurfaceWalk walk(mesh, topology);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const FaceId f : mesh.faces.ids()) {
    const SurfacePoint start{f, Vec3(0.2, 0.3, 0.5)};
    const SurfacePoint same = walk.destination(start, Vec3::Zero());
    EXPECT_EQ(same.face, f);
    EXPECT_LT((same.weights - start.weights).norm(), 1e-12);
    const Vec3 d = 0.2 * Vec3(normal(random), normal(random), normal(random));
    const Vec3 from = walk.flat_point(start);
    const Vec3 tangential = d - d.dot(from.normalized()) * from.normalized();
    const Vec3 reached = walk.flat_point(walk.destination(start, tangential));
    // Projected along face normals instead of the sphere's: off by the face's tilt times its sag.
    const Vec3 radial = (from + tangential).normalized();
    EXPECT_LT((reached.normalized() - radial).norm(), 0.2 * tangential.squaredNorm() + 0.01);
  }
}

}  // namespace
}  // namespace meniscus
