#include "meniscus/mesh/surface_quality.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "tests/mesh/octahedron.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

SurfaceQuality quality_of(const SurfaceMesh& mesh) {
  return surface_quality(mesh, SurfaceTopology(mesh));
}

TEST(SurfaceQuality, OfAnOctahedron) {
  const SurfaceQuality q = quality_of(test::octahedron());
  EXPECT_EQ(q.num_vertices, 6);
  EXPECT_EQ(q.num_faces, 8);
  EXPECT_EQ(q.num_pieces, 1);
  EXPECT_EQ(q.genus, 0);
  for (const double length : {q.min_edge, q.mean_edge, q.max_edge})
    EXPECT_NEAR(length, std::sqrt(2.0), 1e-14);
  for (const double angle :
       {q.min_angle_deg, q.low_angle_deg, q.mean_min_angle_deg, q.max_angle_deg})
    EXPECT_NEAR(angle, 60.0, 1e-12);
  EXPECT_NEAR(q.min_radius_ratio, 1.0, 1e-14);
  EXPECT_NEAR(q.area, 4.0 * std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(q.volume, 4.0 / 3.0, 1e-14);
  EXPECT_EQ(q.min_valence, 4);
  EXPECT_EQ(q.max_valence, 4);
  EXPECT_EQ(q.share_of_valence_6, 0.0);
}

TEST(SurfaceQuality, OfACubeOfRightTriangles) {
  const SurfaceQuality q = quality_of(box(8, Vec3::Ones()).mesh);
  EXPECT_NEAR(q.volume, 8.0, 1e-14);
  EXPECT_NEAR(q.area, 24.0, 1e-14);
  EXPECT_NEAR(q.min_angle_deg, 45.0, 1e-12);
  EXPECT_NEAR(q.max_angle_deg, 90.0, 1e-12);
  EXPECT_NEAR(q.max_edge / q.min_edge, std::sqrt(2.0), 1e-14);
  // Legs 1, hypotenuse √2: r = 1 − 1/√2, R = 1/√2.
  EXPECT_NEAR(q.min_radius_ratio, 2.0 * (std::sqrt(2.0) - 1.0), 1e-12);
  EXPECT_NEAR(q.mean_radius_ratio, q.min_radius_ratio, 1e-12);
}

TEST(SurfaceQuality, CountsHandlesOfAllPieces) {
  const SurfaceMesh ring = test::torus(20, 10, 1.0, 0.4);
  EXPECT_EQ(quality_of(ring).genus, 1);
  const SurfaceQuality q =
      quality_of(joined_surface(std::array{ring, sphere(40, 1.0, Vec3(5, 0, 0)), ring}));
  EXPECT_EQ(q.genus, 2);
  EXPECT_EQ(q.num_pieces, 3);
}

}  // namespace
}  // namespace meniscus
