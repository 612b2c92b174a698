#include "tests/volume/gap_layers.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/volume/quality.hpp"
#include "meniscus/volume/size_law.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

constexpr double kLayers = 3.0;

/// Remeshes every interface of the scene by turns, as evolution does, until the gaps are held by
/// both sides.
void remesh_all(Scene& scene, double nodes, int passes = 4) {
  const SurfaceTree wall(scene.boundary.mesh);
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
      std::vector<SurfaceTree> others;
      for (std::size_t j = 0; j < scene.interfaces.size(); ++j)
        if (j != i) others.emplace_back(scene.interfaces[j].mesh);
      RemeshOptions options = sound_remeshing(nodes / (4.0 * std::numbers::pi));
      options.gap_layers = kLayers;
      options.neighbours = {&wall};
      for (const SurfaceTree& tree : others) options.neighbours.push_back(&tree);
      const RemeshReport report = remesh(scene.interfaces[i].mesh, options);
      ASSERT_TRUE(report.ok()) << report.text();
    }
}

/// Two bulbs of radius about 1 joined by a neck of the given radius, drawn in steps from a sphere
/// and remeshed after each as a run would.
SurfaceMesh drawn_dumbbell(double neck, double nodes) {
  constexpr int kSteps = 30;
  const auto profile = [&](double x, int step) {
    const double depth = (1.0 - neck) * step / kSteps;
    return 1.0 - depth * std::exp(-std::pow(x / 0.5, 2));
  };
  SurfaceMesh mesh = stretched_sphere(600, Vec3(2, 1, 1));
  RemeshOptions options = sound_remeshing(nodes / (4.0 * std::numbers::pi));
  options.gap_layers = kLayers;
  for (int step = 0; step < kSteps; ++step) {
    for (Vec3& x : mesh.x) {
      const double ratio = profile(x.x(), step + 1) / profile(x.x(), step);
      x = Vec3(x.x(), ratio * x.y(), ratio * x.z());
    }
    const RemeshReport report = remesh(mesh, options);
    EXPECT_TRUE(report.ok()) << "step " << step << ": " << report.text();
  }
  return mesh;
}

GapLayers layers_of(const Scene& scene, double asked, double widest) {
  TetMesh mesh;
  const VolumeMeshReport made = tetrahedralize(scene, {.gap_layers = asked}, mesh);
  EXPECT_TRUE(made.ok()) << made.text();
  EXPECT_EQ(made.attempt, 0);
  if (asked > 0.0) {
    EXPECT_GT(quality(mesh).min_dihedral_deg, 5.0);
  }
  return gap_layers(mesh, scene, widest);
}

TEST(GapLayers, DumbbellNeckHoldsTheLayersAskedFor) {
  Scene scene = test::scene_within(sphere(300, 8.0));
  test::add_drop(scene, drawn_dumbbell(0.02, 110.0));
  const GapLayers layers = layers_of(scene, kLayers, 0.06);  // the neck is 0.04 wide
  EXPECT_LT(layers.narrowest, 0.041);
  EXPECT_GE(layers.fewest, kLayers);
  EXPECT_LT(layers_of(scene, 0.0, 0.06).fewest, kLayers);
}

TEST(GapLayers, NearSpheresHoldTheLayersAskedFor) {
  Scene scene = test::scene_within(sphere(300, 8.0));
  test::add_drop(scene, sphere(300, 1.0, Vec3(-1.005, 0, 0)));
  test::add_drop(scene, sphere(300, 1.0, Vec3(1.005, 0, 0)));
  remesh_all(scene, 200.0);
  const GapLayers layers = layers_of(scene, kLayers, 0.04);
  EXPECT_LT(layers.narrowest, 0.012);
  EXPECT_GT(layers.num_vertices, 1000);
  EXPECT_GE(layers.fewest, kLayers);
}

TEST(GapLayers, LobesOfOneDropHoldThemToo) {
  // A torus cut open, bent until its ends nearly meet: a gap outside the drop between two sheets
  // of it.
  SurfaceMesh mesh = stretched_sphere(1500, Vec3(10, 1, 1));
  for (Vec3& x : mesh.x) {
    const double angle = 0.3 * x.x(), radius = 10.0 / 3.0 + x.y();
    x = Vec3(radius * std::sin(angle), radius * std::cos(angle), x.z());
  }
  Scene scene = test::scene_within(sphere(300, 20.0));
  test::add_drop(scene, std::move(mesh));
  remesh_all(scene, 110.0);
  const GapLayers layers = layers_of(scene, kLayers, 1.0);
  EXPECT_GT(layers.num_vertices, 20);
  EXPECT_GE(layers.fewest, kLayers);
}

TEST(GapSize, HoldsTheLayersButNoFinerThanTheSurfaces) {
  EXPECT_DOUBLE_EQ(gap_size(0.5, 3.0, 0.1), 0.8 * 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(gap_size(0.3, 3.0, 0.1), 0.1);
  EXPECT_TRUE(std::isinf(gap_size(0.6, 3.0, 0.1)));  // wider than 7/4 · 3 edges
}

TEST(GapLayers, CountsWhatIsThere) {
  // Without the rule: a gap of a fortieth of an edge is spanned by single edges.
  Scene scene = test::scene_within(sphere(300, 8.0));
  test::add_drop(scene, sphere(300, 1.0, Vec3(-1.005, 0, 0)));
  test::add_drop(scene, sphere(300, 1.0, Vec3(1.005, 0, 0)));
  EXPECT_EQ(layers_of(scene, 0.0, 0.1).fewest, 1);
  // Nothing is as near as that.
  EXPECT_EQ(layers_of(scene, 0.0, 1e-3).num_vertices, 0);
  EXPECT_EQ(layers_of(scene, 0.0, 1e-3).fewest, 0);
}

}  // namespace
}  // namespace meniscus
