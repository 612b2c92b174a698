#include "meniscus/volume/gap_layers.hpp"

#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/volume/quality.hpp"
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
      RemeshOptions options;
      options.C0 = nodes / (4.0 * std::numbers::pi);
      options.gap_layers = kLayers;
      options.find_fault = find_self_intersection;
      options.neighbours = {&wall};
      for (const SurfaceTree& tree : others) options.neighbours.push_back(&tree);
      const RemeshReport report = remesh(scene.interfaces[i].mesh, options);
      ASSERT_TRUE(report.ok) << report.failure;
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
  RemeshOptions options;
  options.C0 = nodes / (4.0 * std::numbers::pi);
  options.gap_layers = kLayers;
  options.find_fault = find_self_intersection;
  for (int step = 0; step < kSteps; ++step) {
    for (Vec3& x : mesh.x) {
      const double ratio = profile(x.x(), step + 1) / profile(x.x(), step);
      x = Vec3(x.x(), ratio * x.y(), ratio * x.z());
    }
    const RemeshReport report = remesh(mesh, options);
    EXPECT_TRUE(report.ok) << "step " << step << ": " << report.failure;
  }
  return mesh;
}

void report(const char* name, const Scene& scene, const TetMesh& mesh, double widest) {
  const GapLayers layers = gap_layers(mesh, scene, widest);
  int n = 0;
  for (const Interface& i : scene.interfaces) n += i.mesh.num_vertices();
  fmt::print(
      "{}: {} surface vertices, {} nodes, widest {} narrowest {:.4f}: fewest {} mean {:.2f} over "
      "{}; min dihedral {:.2f}\n",
      name, n, mesh.num_vertices(), widest, layers.narrowest, layers.fewest, layers.mean,
      layers.num_vertices, quality(mesh).min_dihedral_deg);
}

TEST(GapLayers, DumbbellNeckHoldsTheLayersAskedFor) {
  for (double nodes : {40.0, 60.0, 80.0, 110.0}) {
    Scene scene = test::scene_within(sphere(300, 8.0));
    test::add_drop(scene, drawn_dumbbell(0.02, nodes));
    TetMesh mesh;
    const VolumeMeshReport made = tetrahedralize(scene, {.gap_layers = kLayers}, mesh);
    ASSERT_TRUE(made.ok) << made.failure;
    for (double w : {0.045, 0.06, 0.1}) report("neck", scene, mesh, w);
    TetMesh plain;
    ASSERT_TRUE(tetrahedralize(scene, {}, plain).ok);
    report("neck plain", scene, plain, 0.06);
  }
}

TEST(GapLayers, NearSpheresHoldTheLayersAskedFor) {
  Scene scene = test::scene_within(sphere(300, 8.0));
  test::add_drop(scene, sphere(300, 1.0, Vec3(-1.005, 0, 0)));
  test::add_drop(scene, sphere(300, 1.0, Vec3(1.005, 0, 0)));
  remesh_all(scene, 200.0);
  TetMesh mesh;
  const VolumeMeshReport made = tetrahedralize(scene, {.gap_layers = kLayers}, mesh);
  ASSERT_TRUE(made.ok) << made.failure;
  for (double w : {0.012, 0.02, 0.04, 0.1}) report("spheres", scene, mesh, w);
  TetMesh plain;
  ASSERT_TRUE(tetrahedralize(scene, {}, plain).ok);
  report("spheres plain", scene, plain, 0.02);
}

}  // namespace
}  // namespace meniscus
