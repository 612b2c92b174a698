#include "meniscus/surface/diffused.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

constexpr double kMostLost = 0.05;

TEST(DiffusedSurface, OfASphereIsTheSphere) {
  const SurfaceMesh mesh = sphere(1000, 1.0);
  const double edge = mean_edge(mesh);
  DiffusedSurface diffused(mesh, edge);
  for (const double length : {0.5, 1.0, 2.0}) {
    const std::optional<SurfaceMesh> smooth = diffused.smoother_surface(length * edge, kMostLost);
    ASSERT_TRUE(smooth);
    EXPECT_EQ(text_of(find_defect(*smooth)), "");
    EXPECT_NEAR(enclosed_volume(*smooth), enclosed_volume(mesh), 1e-12 * enclosed_volume(mesh));
    // Vertices of the contour lie within 0.05 of a lattice edge, √3 edge/2 at most, of it.
    for (const Vec3& x : smooth->x) EXPECT_NEAR(x.norm(), 1.0, 0.05 * edge);
  }
}

TEST(DiffusedSurface, LosesTheRoughnessAndKeepsTheVolume) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.4, 0.4);
  SurfaceMesh mesh = sphere(400, 1.0);
  for (Vec3& x : mesh.x) x *= 1.0 + uniform(random);
  const double edge = mean_edge(mesh), volume = enclosed_volume(mesh);
  DiffusedSurface diffused(mesh, edge);
  double area = surface_area(mesh);
  for (const double length : {0.5, 0.71, 1.0, 1.41, 2.0}) {
    const std::optional<SurfaceMesh> smooth = diffused.smoother_surface(length * edge, kMostLost);
    ASSERT_TRUE(smooth) << length;
    EXPECT_EQ(text_of(find_defect(*smooth)), "") << length;
    EXPECT_NEAR(enclosed_volume(*smooth), volume, 1e-12 * volume);
    EXPECT_LT(surface_area(*smooth), area);
    area = surface_area(*smooth);
  }
  // Over s = 2 edges some 50 vertices have their mean, 0.23/√50 off: waves of that height and of
  // length 2π s add less than 1 % of area.
  EXPECT_LT(area, 1.05 * std::cbrt(36.0 * std::numbers::pi * volume * volume));
}

TEST(DiffusedSurface, ThatBreaksIsNone) {
  // A dumbbell whose handle is thinner than what it is smoothed over.
  SurfaceMesh mesh = sphere(2000, 1.0);
  for (Vec3& x : mesh.x) {
    const double waist = std::min(1.0, 0.06 + 1.5 * std::pow(std::abs(x.z()), 2));
    x = Vec3(x.x() * waist, x.y() * waist, 2.0 * x.z());
  }
  DiffusedSurface diffused(mesh, mean_edge(mesh));
  EXPECT_FALSE(diffused.smoother_surface(2.0 * mean_edge(mesh), kMostLost));
}

}  // namespace
}  // namespace meniscus
