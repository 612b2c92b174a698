#include "meniscus/surface/foreseen_vertices.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/solids/remesh_target.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

/// An octahedron of size 1e-9 with one vertex far away.
SurfaceMesh needle(double far) {
  SurfaceMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1e-9, -1e-9}) {
      Vec3 x = Vec3::Zero();
      x[axis] = side;
      mesh.x.add(x);
    }
  mesh.x[VertexId{0}].x() = far;
  for (const int x : {0, 1})
    for (const int y : {2, 3})
      for (const int z : {4, 5}) {
        const bool is_even = (x + y + z) % 2 == 0;
        mesh.faces.add({VertexId{x}, VertexId{is_even ? y : z}, VertexId{is_even ? z : y}});
      }
  return mesh;
}

TEST(ForeseenVertices, AreThoseThatRemeshingMakes) {
  for (const int wanted : {200, 800}) {
    SurfaceMesh mesh = stretched_sphere(400, Vec3(1.5, 1.0, 0.7));
    const double C0 = wanted / (4.0 * std::numbers::pi);
    const RemeshReport report = remesh(mesh, {.C0 = C0});
    ASSERT_TRUE(report.ok()) << report.text();
    const double length = std::sqrt(2.0 * 4.0 * std::numbers::pi / (std::numbers::sqrt3 * wanted));
    const ForeseenVertices even = foresee_vertices(sphere(400), length);
    EXPECT_NEAR(even.number, wanted, 0.05 * wanted);  // the flat faces' area is smaller
    EXPECT_FALSE(even.is_too_many());
  }
}

TEST(ForeseenVertices, KnowNeedlesAndWhatIsNoNumber) {
  const SurfaceMesh mesh = needle(1.0);
  const ForeseenVertices foreseen = foresee_vertices(mesh, 1e-9);
  EXPECT_TRUE(foreseen.is_too_many());
  EXPECT_NEAR(foreseen.number, 4e9, 1e7);  // four edges of length 1
  EXPECT_EQ(foreseen.a, VertexId{0});
  EXPECT_NE(too_many(foreseen, mesh).find("(1, 0, 0)"), std::string::npos);
  for (const double length : {0.0, std::nan(""), -1e-3})
    EXPECT_TRUE(foresee_vertices(sphere(100), length).is_too_many()) << length;
  EXPECT_FALSE(foresee_vertices(sphere(100), 1e300).is_too_many());
}

TEST(ForeseenVertices, RemeshingRefusesAbsurdLengthsAndLeavesTheSurface) {
  SurfaceMesh mesh = sphere(100);
  const RemeshReport report = remesh(mesh, {.C0 = 1e12});
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.text().find("vertices; at most 2e+06"), std::string::npos) << report.text();
  EXPECT_EQ(mesh, sphere(100));
}

TEST(ForeseenVertices, ThinSurfacesAreRefusedWithTheLongestCrease) {
  for (const double far : {1e-3, 1.0, 1e50, 1e99})
    for (const double nodes : {12.0, 100.0}) {
      SurfaceMesh mesh = needle(far);
      try {
        static_cast<void>(remesh_to(mesh, {.value = nodes}));
        ADD_FAILURE() << far;
      } catch (const InvalidInput& refused) {
        EXPECT_NE(std::string(refused.what()).find("too thin"), std::string::npos)
            << refused.what();
      }
    }
}

}  // namespace
}  // namespace meniscus
