#include "meniscus/evolve/drop_shape.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/surface/remesh.hpp"

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
  PlanarErrors before = planar_errors(110);
  EXPECT_LT(before.length, 2e-3);
  EXPECT_LT(before.angle_deg, 0.7);
  for (const int count : {440, 1760}) {
    const PlanarErrors now = planar_errors(count);
    EXPECT_LT(now.length, before.length / 8.0) << count;
    EXPECT_LT(now.angle_deg, before.angle_deg / 8.0) << count;
    before = now;
  }
}

/// Largest error of L, B and W of a spheroid over random meshes of some C0 = N0/4π, with its tips
/// anywhere on faces.
double spheroid_error(int N0) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double error = 0.0;
  for (int k = 0; k < 10; ++k) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized();
    SurfaceMesh mesh = sphere(3000, 1.0, Vec3::Zero());
    for (Vec3& x : mesh.x) x = Vec3(1.4, 0.85, 0.85).cwiseProduct(turn * x);
    RemeshOptions options = sound_remeshing(N0 / (4.0 * std::numbers::pi));
    options.restores_volume = false;
    EXPECT_TRUE(remesh(mesh, options).ok());
    const DropShape s =
        drop_shape(mesh, FlowFamily::axial, ReconstructedSurface(mesh, SurfaceShape::splined));
    for (const double e : {s.L - 1.4, s.B - 0.85, s.W - 0.85}) error = std::max(error, std::abs(e));
  }
  return error;
}

TEST(DropShape, TipsBetweenVerticesAreFound) {
  EXPECT_LT(spheroid_error(110), 1.5e-4);
  EXPECT_LT(spheroid_error(440), 1.5e-5);
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
    EXPECT_NEAR(s.H_max, 1.0, 1e-9);
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
  EXPECT_NEAR(axial.H_max, 1.6 / 0.64, 0.01);
  const DropShape general = flat_shape(
      rotated_ellipsoid(800, Vec3(1.6, 1.0, 0.7), 40.0, Vec3::Zero()), FlowFamily::general);
  EXPECT_NEAR(general.L, 1.6, 3e-3);
  EXPECT_NEAR(general.B, 0.7, 3e-3);
  EXPECT_NEAR(general.W, 1.0, 3e-3);
  EXPECT_NEAR(general.D_inertia, (1.6 - 0.7) / (1.6 + 0.7), 1e-3);
}

}  // namespace
}  // namespace meniscus
