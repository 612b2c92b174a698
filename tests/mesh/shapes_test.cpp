#include "meniscus/mesh/shapes.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

TEST(Shapes, SphereIsClosedRoundAndEvenlySpaced) {
  for (const int count : {12, 42, 110, 507}) {
    const SurfaceMesh mesh = sphere(count, 2.0, Vec3(1.0, -3.0, 0.5));
    const SurfaceTopology topology(mesh);
    EXPECT_EQ(mesh.num_vertices(), count);
    EXPECT_EQ(mesh.num_faces(), 2 * count - 4);
    for (const Vec3& x : mesh.x) EXPECT_NEAR((x - Vec3(1.0, -3.0, 0.5)).norm(), 2.0, 1e-14);
    // Flat faces of edge h lie h²/8 below the sphere on average: 3h²/8 = √3π/N = 5.44/N of the
    // volume.
    const double exact = 4.0 / 3.0 * std::numbers::pi * 8.0;
    EXPECT_LT(enclosed_volume(mesh), exact);
    EXPECT_GT(enclosed_volume(mesh), exact * (1.0 - 6.0 / count));
    EXPECT_GT(smallest_angle_deg(mesh), 30.0) << count;
  }
}

TEST(Shapes, BoxHasItsVolumeAndTaggedSides) {
  const TaggedSurface surface = box(507, Vec3(10.0, 10.0, 10.0));
  const SurfaceTopology topology(surface.mesh);
  EXPECT_NEAR(surface.mesh.num_vertices(), 507, 60);
  EXPECT_NEAR(enclosed_volume(surface.mesh), 8000.0, 1e-9);
  for (const FaceId f : surface.mesh.faces.ids()) {
    const Vec3 n = face_area_vector(surface.mesh, f).normalized();
    const int axis = surface.tag[f] / 2;
    EXPECT_NEAR(n[axis], surface.tag[f] % 2 == 0 ? -1.0 : 1.0, 1e-12);
  }
}

TEST(Shapes, CylinderIsClosedAndOutward) {
  for (const int count : {60, 300, 2000}) {
    const TaggedSurface surface = cylinder(count, 2.0, 5.0);
    const SurfaceTopology topology(surface.mesh);
    EXPECT_NEAR(surface.mesh.num_vertices(), count, 0.35 * count);
    EXPECT_NEAR(enclosed_volume(surface.mesh), std::numbers::pi * 4.0 * 10.0, 0.2 * 125.0);
    for (const FaceId f : surface.mesh.faces.ids()) {
      const Vec3 n = face_area_vector(surface.mesh, f).normalized();
      if (surface.tag[f] != 0) {
        EXPECT_NEAR(n.x(), surface.tag[f] == 1 ? -1.0 : 1.0, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace meniscus
