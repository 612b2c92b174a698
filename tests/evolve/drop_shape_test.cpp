#include "meniscus/evolve/drop_shape.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

DropShape flat_shape(const SurfaceMesh& mesh, FlowFamily family) {
  return drop_shape(mesh, family, ReconstructedSurface(mesh, SurfaceShape::faceted));
}

SurfaceMesh rotated_ellipsoid(int num_vertices, const Vec3& axes, double angle_deg,
                              const Vec3& center) {
  SurfaceMesh mesh = stretched_sphere(num_vertices, axes);
  const Mat3 turn =
      Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180.0, Vec3::UnitZ()).toRotationMatrix();
  for (Vec3& x : mesh.x) x = center + turn * x;
  return mesh;
}

/// Errors of L, B, W and extent_x, and of the angle, of a tilted ellipsoid: means over nine tilts.
struct PlanarErrors {
  double length = 0.0, angle_deg = 0.0;
};
PlanarErrors planar_errors(int num_vertices) {
  PlanarErrors mean;
  for (int k = 0; k < 9; ++k) {
    const double angle = 5.0 + 8.5 * k, radians = angle * std::numbers::pi / 180.0;
    const SurfaceMesh mesh =
        rotated_ellipsoid(num_vertices, Vec3(1.5, 0.75, 0.9), angle, Vec3(2.0, -1.0, 0.5));
    const DropShape s = flat_shape(mesh, FlowFamily::planar);
    const double extent = std::hypot(1.5 * std::cos(radians), 0.75 * std::sin(radians));
    mean.length += (std::abs(s.L - 1.5) + std::abs(s.B - 0.75) + std::abs(s.W - 0.9) +
                    std::abs(s.extent_x - extent)) /
                   36.0;
    mean.angle_deg += std::abs(s.angle_deg.value_or(1e9) - angle) / 9.0;
  }
  return mean;
}

TEST(DropShape, PlanarMeasuresOfATiltedEllipsoidConverge) {
  // The section's points lie on cubics through the vertices, its extrema on parabolas: better than
  // second order in h, a factor of four from one level to the next.
  PlanarErrors before = planar_errors(110);
  EXPECT_LT(before.length, 3e-3);
  EXPECT_LT(before.angle_deg, 1.0);
  for (const int count : {440, 1760}) {
    const PlanarErrors now = planar_errors(count);
    EXPECT_LT(now.length, before.length / 4.0) << count;
    EXPECT_LT(now.angle_deg, before.angle_deg / 2.0) << count;
    before = now;
  }
}

TEST(DropShape, SphereHasNoDeformationInAnyFlow) {
  for (const FlowFamily family :
       {FlowFamily::planar, FlowFamily::axial, FlowFamily::quiescent, FlowFamily::general}) {
    const DropShape s = flat_shape(sphere(200, 1.0, Vec3(1, 2, 3)), family);
    EXPECT_NEAR(s.L, 1.0, 2e-3);
    EXPECT_NEAR(s.B, 1.0, 2e-3);
    EXPECT_NEAR(s.W, 1.0, 2e-3);
    EXPECT_NEAR(s.D, 0.0, 2e-3);
    EXPECT_NEAR(s.extent_x, 1.0, 2e-3);
    EXPECT_NEAR(s.D_inertia, 0.0, 2e-3);
    EXPECT_LT((s.centroid - Vec3(1, 2, 3)).norm(), 2e-3);
    EXPECT_EQ(s.angle_deg.has_value(), family == FlowFamily::planar);
  }
}

TEST(DropShape, AxialAndGeneralMeasuresOfAnEllipsoid) {
  const DropShape axial = flat_shape(stretched_sphere(800, Vec3(1.6, 0.8, 0.8)), FlowFamily::axial);
  EXPECT_NEAR(axial.L, 1.6, 2e-3);
  EXPECT_NEAR(axial.B, 0.8, 2e-3);
  EXPECT_EQ(axial.B, axial.W);
  // Half-sum of curvatures at the tip of a prolate spheroid: a/b².
  EXPECT_NEAR(axial.H_max, 1.6 / 0.64, 0.1);
  const DropShape general = flat_shape(
      rotated_ellipsoid(800, Vec3(1.6, 1.0, 0.7), 40.0, Vec3::Zero()), FlowFamily::general);
  EXPECT_NEAR(general.L, 1.6, 3e-3);
  EXPECT_NEAR(general.B, 0.7, 3e-3);
  EXPECT_NEAR(general.W, 1.0, 3e-3);
  EXPECT_NEAR(general.D_inertia, (1.6 - 0.7) / (1.6 + 0.7), 1e-3);
}

}  // namespace
}  // namespace meniscus
