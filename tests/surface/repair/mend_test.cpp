#include "meniscus/surface/repair/mend.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

RemeshOptions coarse() { return {.C0 = 10.0, .edge_floor = 0.05}; }

/// A sphere with a slit pressed into it along a great circle's arc: its sides meet at the bottom
/// and turn by 180° there.
SurfaceMesh slit_sphere(double depth) {
  SurfaceMesh mesh = sphere(1200, 1.0);
  for (Vec3& x : mesh.x) {
    const double across = std::abs(x.y()) / 0.05, along = std::abs(x.x()) / 0.4;
    if (x.z() > 0.0 && across < 1.0 && along < 1.0) x *= 1.0 - depth * (1.0 - across);
  }
  return mesh;
}

TEST(Mend, LeavesWhatCanBeRemeshedToTheRemesher) {
  SurfaceMesh mended = sphere(400, 1.0), remeshed = mended;
  const MendReport report = remesh_or_mend(mended, coarse());
  EXPECT_TRUE(report.remesh.ok());
  EXPECT_FALSE(report.is_mended);
  ASSERT_TRUE(remesh(remeshed, coarse()).ok());
  EXPECT_EQ(mended, remeshed);
}

TEST(Mend, LeavesASoundSurfaceOfTheSameVolumeWhereCreasesAreSharp) {
  RemeshOptions options = coarse();
  options.find_fault = find_self_intersection;
  bool was_mended = false;
  for (const double depth : {0.2, 0.3, 0.4, 0.5, 0.6}) {
    SurfaceMesh mesh = slit_sphere(depth);
    const double volume = enclosed_volume(mesh);
    const MendReport report = remesh_or_mend(mesh, options);
    ASSERT_TRUE(report.remesh.ok()) << depth << ": " << report.remesh.text();
    was_mended = was_mended || report.is_mended;
    EXPECT_EQ(text_of(find_defect(mesh)), "");
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12 * volume);
  }
  EXPECT_TRUE(was_mended) << "no slit was too sharp for the remesher";
}

/// What `remesh_or_mend` has to leave of a surface, whatever it takes.
void expect_mended(SurfaceMesh mesh, RemeshOptions options, const std::string& what) {
  options.find_fault = find_self_intersection;
  ASSERT_EQ(text_of(find_defect(mesh)), "") << what;
  const double volume = enclosed_volume(mesh);
  const MendReport report = remesh_or_mend(mesh, options);
  EXPECT_TRUE(report.remesh.ok()) << what << ": " << report.remesh.text();
  EXPECT_EQ(text_of(find_defect(mesh)), "") << what;
  EXPECT_EQ(euler_characteristic(mesh), 2) << what;
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12 * volume) << what;
}

TEST(Mend, LeavesASoundSurfaceOfTheSameVolumeWhereAllOfItIsCrumpled) {
  for (const unsigned seed : {1U, 2U, 3U})
    for (const double height : {0.3, 0.5}) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-height, height);
      SurfaceMesh mesh = sphere(400, 1.0);
      for (Vec3& x : mesh.x) x *= 1.0 + uniform(random);
      expect_mended(mesh, coarse(), fmt::format("seed {}, height {}", seed, height));
    }
}

TEST(Mend, GivesVerticesToAShapeThatHasTooFew) {
  // Saucers, whose rims have one vertex between the two sides.
  const RemeshOptions options{.C0 = 42.0 / (4.0 * std::numbers::pi), .edge_floor = 0.05};
  for (const double thickness : {0.1, 0.15, 0.2, 0.25, 0.3})
    for (const double depth : {0.3, 0.6, 1.0}) {
      SurfaceMesh mesh = sphere(42, 1.0);
      for (Vec3& x : mesh.x) x.z() = thickness * x.z() + depth * x.x() * x.x();
      expect_mended(mesh, options, fmt::format("thickness {}, depth {}", thickness, depth));
    }
}

TEST(Mend, TellsHowFarItSmoothed) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.4, 0.4);
  SurfaceMesh mesh = sphere(400, 1.0);
  for (Vec3& x : mesh.x) x *= 1.0 + uniform(random);
  const double edge = mean_edge(mesh);
  const MendReport report = remesh_or_mend(mesh, coarse());
  EXPECT_TRUE(report.is_mended);
  EXPECT_GT(report.smoothed_over, 0.0);
  EXPECT_LE(report.smoothed_over, 2.0 * edge);
}

}  // namespace
}  // namespace meniscus
