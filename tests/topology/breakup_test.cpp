#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "tests/surface/shapes.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

// The density of the meshes below: with another, a remeshing alone would change areas.
constexpr double kC0 = 9.0;

using test::fault_after, test::scene_of, test::wavy_thread;

/// The part with side · x > 0 of the volume that a surface encloses: ∮ max(side · x, 0) side · n_x
/// dS.
double volume_beyond_origin(const SurfaceMesh& mesh, double side) {
  double volume = 0.0;
  for (const FaceId f : mesh.faces.ids()) {
    double mean = 0.0;
    for (const VertexId v : mesh.faces[f]) mean += std::max(side * mesh.x[v].x(), 0.0) / 3.0;
    volume += mean * side * face_area_vector(mesh, f).x();
  }
  return volume;
}

TEST(Breakup, CutsADumbbellInTwoEqualDrops) {
  const std::vector<SurfaceMesh> meshes{wavy_thread(2.0, 0.5, 4, -0.9, 1, kC0)};
  Scene scene = scene_of(meshes, kC0);
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.06}, {});
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  const TopologyEvent& event = report.events[0];
  EXPECT_EQ(event.kind, EventKind::breakup);
  EXPECT_EQ(event.parents, std::vector<int>{0});
  EXPECT_EQ(event.children, (std::vector<int>{1, 2}));
  EXPECT_FALSE(event.gap);
  ASSERT_EQ(scene.interfaces.size(), 2U);
  for (const Interface& drop : scene.interfaces) {
    EXPECT_EQ(drop.parent, 0);
    // What lay on its side, but for the irregular mesh at the cut: a slice as long as a radius.
    const double side = enclosed_centroid(drop.mesh).x() > 0.0 ? 1.0 : -1.0;
    EXPECT_NEAR(drop.volume, volume_beyond_origin(meshes[0], side),
                std::numbers::pi * std::pow(0.05, 3));
    EXPECT_EQ(euler_characteristic(drop.mesh), 2);
  }
  EXPECT_LT(event.volume_moved, 3.0 * std::numbers::pi * std::pow(0.05, 3));
}

TEST(Breakup, CutsALongThreadInSeveralPlacesAtOnce) {
  const std::vector<SurfaceMesh> meshes{wavy_thread(4.0, 0.2, 24, -0.8, 3, kC0)};
  Scene scene = scene_of(meshes, kC0);
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.05}, {});
  EXPECT_EQ(report.events.size(), 3U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  EXPECT_EQ(scene.interfaces.size(), 4U);
}

/// A thread with a knob at one end, the neck before it narrower than the thread by a factor.
SurfaceMesh knobbed_thread(double factor) {
  return test::revolved(
      1.0,
      [=](double xi) {
        const double round = 0.22 * std::sqrt(std::max(0.0, 1.0 - std::pow(xi, 8)));
        return round * (1.0 - (1.0 - factor) * std::exp(-std::pow((xi - 0.7) / 0.12, 2)));
      },
      kC0);
}

TEST(Breakup, WaitsWhereTheCutWouldAddArea) {
  // The knob is hardly wider than its neck: to give it half of what is taken out swells it.
  {
    const std::vector<SurfaceMesh> meshes{knobbed_thread(0.55)};
    Scene scene = scene_of(meshes, kC0);
    const Scene before = scene;
    const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.17}, {});
    EXPECT_EQ(fault_after(before, scene, report), "");
    EXPECT_EQ(report.events.size(), 0U);
    EXPECT_EQ(report.warnings.size(), 1U);
    EXPECT_EQ(scene.interfaces[0].mesh.x, before.interfaces[0].mesh.x);
  }
  // Thinner, it is cut.
  const std::vector<SurfaceMesh> meshes{knobbed_thread(0.2)};
  Scene scene = scene_of(meshes, kC0);
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.17}, {});
  EXPECT_EQ(fault_after(before, scene, report), "");
  EXPECT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
}

/// Whether the knob comes off when everything is `scale` times as large.
bool is_cut(SurfaceMesh mesh, double scale) {
  for (Vec3& x : mesh.x) x *= scale;
  const std::vector<SurfaceMesh> meshes{std::move(mesh)};
  Scene scene = scene_of(meshes, kC0);
  const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.17 * scale}, {});
  return !report.events.empty();
}

TEST(Breakup, BoundsTheAddedAreaByTheSizeOfTheDrop) {
  for (const auto& [factor, is_allowed] : {std::pair(0.2, true), {0.55, false}}) {
    const SurfaceMesh mesh = knobbed_thread(factor);
    for (const double scale : {0.1, 1.0, 30.0})
      EXPECT_EQ(is_cut(mesh, scale), is_allowed) << "factor " << factor << ", scale " << scale;
  }
}

TEST(Breakup, LeavesATorusInOnePiece) {
  // A torus whose tube thins to 0.05 on one side.
  SurfaceMesh mesh = test::torus(96, 12, 1.0, 0.3);
  for (Vec3& x : mesh.x) {
    const double rho = std::hypot(x.x(), x.y());
    const Vec3 c(x.x() / rho, x.y() / rho, 0.0);
    const double thinner = 1.0 - (0.25 / 0.3) * std::exp(-4.0 * (1.0 - c.x()));
    x = c + thinner * (x - c);
  }
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(remesh(mesh, {.C0 = kC0}).ok());
  const std::vector<SurfaceMesh> meshes{mesh};
  Scene scene = scene_of(meshes, kC0);
  const Scene before = scene;
  EXPECT_EQ(euler_characteristic(mesh), 0);
  const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.06}, {});
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(scene.interfaces[0].drop, 1);
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 2);
}

TEST(Breakup, LeavesAnInnerDropInTheFragmentThatHoldsIt) {
  const std::vector<SurfaceMesh> meshes{wavy_thread(2.0, 0.5, 4, -0.9, 1, kC0),
                                        sphere(100, 0.2, Vec3(-1.0, 0, 0))};
  Scene scene = scene_of(meshes, kC0);
  scene.liquids[RegionId{2}].viscosity = 7.0;
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.06}, {});
  ASSERT_EQ(report.events.size(), 1U);
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 3U);
  EXPECT_EQ(scene.interfaces[0].drop, 1);  // what stays comes first
  EXPECT_EQ(scene.liquids[scene.interfaces[0].inside].viscosity, 7.0);
  for (std::size_t i = 1; i < 3; ++i) {
    const bool is_left = enclosed_centroid(scene.interfaces[i].mesh).x() < 0.0;
    EXPECT_EQ(scene.interfaces[0].outside == scene.interfaces[i].inside, is_left);
  }
  const RegionId matrix{0}, whole{1}, inner{2};
  EXPECT_EQ(report.events[0].sources,
            RegionSources({std::vector{matrix}, {inner}, {whole}, {whole}}));
}

TEST(Breakup, DoesNotDependOnTheNumberingOfVertices) {
  const SurfaceMesh mesh = wavy_thread(4.0, 0.2, 24, -0.8, 3, kC0);
  const auto broken = [](const SurfaceMesh& whole) {
    const std::vector<SurfaceMesh> meshes{whole};
    Scene scene = scene_of(meshes, kC0);
    const TopologyReport report = apply_topology(scene, {.breakup_radius = 0.05}, {});
    EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
    return scene;
  };
  const Scene scene = broken(mesh);
  for (const unsigned seed : {4U, 5U}) {
    const Scene other = broken(test::shuffled(mesh, seed));
    ASSERT_EQ(other.interfaces.size(), scene.interfaces.size());
    // The cuts are alike; the triangles of CGAL's caps depend on the numbering a little. The caps
    // enclose about π r³/3 each, and a drop has up to two.
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
      EXPECT_NEAR(other.interfaces[i].volume, scene.interfaces[i].volume,
                  0.05 * 2.0 * std::numbers::pi / 3 * std::pow(0.04, 3))
          << "seed " << seed;
  }
}

TEST(Breakup, GivesASatelliteBelowTheEdgeFloorItsVertices) {
  // Two necks of radius 0.02 on either side of a bead of radius 0.06, with an edge floor that would
  // leave it a handful of vertices.
  const auto profile = [](double xi) {
    const double bead = 0.04 * std::exp(-std::pow(xi / 0.05, 2));
    return std::sqrt(std::max(0.0, 1.0 - std::pow(xi, 4))) *
           (0.02 + bead + 0.8 * std::pow(xi * xi, 2.0));
  };
  const std::vector<SurfaceMesh> meshes{test::revolved(2.0, profile, kC0)};
  Scene scene = scene_of(meshes, kC0);
  const Scene before = scene;
  const TopologyReport report =
      apply_topology(scene, {.breakup_radius = 0.03, .edge_floor = 0.06}, {});
  EXPECT_EQ(report.events.size(), 2U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  EXPECT_EQ(scene.interfaces.size(), 3U);
}

}  // namespace
}  // namespace meniscus
