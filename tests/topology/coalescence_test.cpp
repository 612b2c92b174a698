#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/topology/bridge_gap.hpp"
#include "meniscus/topology/cut_neck.hpp"
#include "meniscus/topology/gaps.hpp"
#include "meniscus/topology/successors.hpp"
#include "tests/surface/shapes.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

using test::fault_after, test::scene_of;

constexpr double kGap = 0.02;
const TopologyOptions kMerge{.coalescence = true, .coalescence_gap = kGap};

RegionSources sources_of(std::vector<std::vector<RegionId>> sources) {
  return RegionSources(std::move(sources));
}

SurfaceMesh unit_sphere(const Vec3& center, int vertices = 400) {
  SurfaceMesh mesh = sphere(vertices, 1.0, center);
  EXPECT_TRUE(remesh(mesh, {.C0 = vertices / (4.0 * std::numbers::pi)}).ok());
  return mesh;
}

/// Two unit spheres whose surfaces are `gap` apart on the x-axis.
Scene two_spheres(double gap) {
  const std::vector<SurfaceMesh> meshes{unit_sphere(Vec3(-1.0 - gap / 2, 0, 0)),
                                        unit_sphere(Vec3(1.0 + gap / 2, 0, 0))};
  return scene_of(meshes, 400 / (4.0 * std::numbers::pi));
}

TEST(Coalescence, JoinsTwoSpheresThatApproach) {
  Scene scene = two_spheres(0.5 * kGap);
  const Scene before = scene;
  const auto toward = [](const Vec3& x) { return Vec3(x.x() < 0.0 ? 1.0 : -1.0, 0, 0); };
  const TopologyReport report = apply_topology(scene, kMerge, test::motion_of(scene, toward));
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  const TopologyEvent& event = report.events[0];
  EXPECT_EQ(event.kind, EventKind::coalescence);
  EXPECT_EQ(event.parents, (std::vector<int>{0, 1}));
  EXPECT_EQ(event.children, std::vector<int>{2});
  EXPECT_FALSE(event.neck_radius);
  ASSERT_TRUE(event.gap);
  EXPECT_LT(*event.gap, kGap);
  EXPECT_GE(*event.gap, 0.5 * kGap);
  // Vertices are an edge apart, 0.17, and the spheres flat there over half of that: 0.17²/4.
  EXPECT_LT(event.position.norm(), 0.17);
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 2);
  EXPECT_EQ(scene.interfaces[0].parent, 0);
  EXPECT_LT(event.area_after, event.area_before);
}

TEST(Coalescence, LeavesDropsThatPartOrAreFarAlone) {
  Scene scene = two_spheres(0.5 * kGap);
  const auto apart = [](const Vec3& x) { return Vec3(x.x() < 0.0 ? -1.0 : 1.0, 0, 0); };
  EXPECT_TRUE(apply_topology(scene, kMerge, test::motion_of(scene, apart)).events.empty());
  Scene far = two_spheres(1.2 * kGap);
  EXPECT_TRUE(apply_topology(far, kMerge, {}).events.empty());
  Scene off = two_spheres(0.5 * kGap);
  EXPECT_TRUE(apply_topology(off, {.coalescence_gap = kGap}, {}).events.empty());
}

TEST(Coalescence, OfUnlikeLiquidsIsRefused) {
  Scene scene = two_spheres(0.5 * kGap);
  scene.liquids[RegionId{2}].viscosity = 3.0;
  const Scene before = scene;
  TopologyReport report = apply_topology(scene, kMerge, {});
  EXPECT_NE(text_of(report.refusal).find("viscosity ratios 1 and 3"), std::string::npos)
      << text_of(report.refusal);
  EXPECT_TRUE(report.events.empty());
  EXPECT_EQ(scene.interfaces[0].mesh, before.interfaces[0].mesh);
  scene.liquids[RegionId{2}].viscosity = 1.0;
  scene.liquids[RegionId{2}].law = PowerLaw{.power_index = 0.5};
  report = apply_topology(scene, kMerge, {});
  EXPECT_NE(text_of(report.refusal).find("different laws of viscosity"), std::string::npos)
      << text_of(report.refusal);
  scene.liquids[RegionId{2}].law = {};
  scene.interfaces[1].tension = 2.0;
  report = apply_topology(scene, kMerge, {});
  EXPECT_NE(text_of(report.refusal).find("surface tensions 1 and 2"), std::string::npos)
      << text_of(report.refusal);
}

TEST(Coalescence, ReleasesADropFromTheDropAroundIt) {
  // An inner drop of the matrix's liquid, off centre: the film of the outer drop's liquid opens.
  const std::vector<SurfaceMesh> meshes{unit_sphere(Vec3::Zero()),
                                        sphere(200, 0.4, Vec3(0.6 - 0.5 * kGap, 0, 0))};
  Scene scene = scene_of(meshes, 400 / (4.0 * std::numbers::pi));
  scene.liquids[RegionId{1}].viscosity = 5.0;
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, kMerge, {});
  ASSERT_EQ(report.events.size(), 1U)
      << text_of(report.refusal) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(scene.liquids[RegionId{1}].viscosity, 5.0);
  EXPECT_NEAR(scene.interfaces[0].volume, before.interfaces[0].volume - before.interfaces[1].volume,
              1e-12);
  const RegionId matrix{0}, outer{1}, inner{2};
  EXPECT_EQ(report.events[0].sources, sources_of({{matrix, inner}, {outer}}));
}

TEST(Coalescence, TakesUpADropThatIsSmallerThanTheHole) {
  for (const double inside : {1.0, -1.0}) {  // beside the drop, and within it
    const double radius = 0.5 * kGap, gap = 0.5 * kGap;
    const std::vector<SurfaceMesh> meshes{
        unit_sphere(Vec3::Zero()),
        sphere(42, radius, (1.0 + inside * (radius + gap)) * Vec3::UnitX())};
    Scene scene = scene_of(meshes, 400 / (4.0 * std::numbers::pi));
    // The faces of the large sphere lie up to 0.17²/8 below it.
    const double off = gap - smallest_gap(meshes[0], meshes[1]);
    for (Vec3& x : scene.interfaces[1].mesh.x) x.x() += inside * off;
    const Scene before = scene;
    const TopologyReport report = apply_topology(scene, kMerge, {});
    ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
    EXPECT_EQ(fault_after(before, scene, report), "");
    ASSERT_EQ(scene.interfaces.size(), 1U);
    EXPECT_NEAR(scene.interfaces[0].volume,
                before.interfaces[0].volume + inside * before.interfaces[1].volume, 1e-12);
    EXPECT_LT(report.events[0].area_after, report.events[0].area_before);
  }
}

TEST(Coalescence, MovesLittleOfTheLiquidOfSmallDrops) {
  // The first hole that is tried is as wide as these drops, or as their halves that face each
  // other.
  for (const double aspect : {1.0, 0.5, 0.3})
    for (const double radius : {1.5 * kGap, 2.0 * kGap, 3.0 * kGap}) {
      std::vector<SurfaceMesh> meshes;
      for (const double side : {-1.0, 1.0}) {
        meshes.push_back(sphere(162, 1.0));
        for (Vec3& x : meshes.back().x)
          x = radius * Vec3(aspect * x.x(), x.y(), x.z()) +
              side * (aspect * radius + 0.3 * kGap) * Vec3::UnitX();
      }
      Scene scene = scene_of(meshes, 42 / (4.0 * std::numbers::pi));
      const Scene before = scene;
      const TopologyReport report = apply_topology(scene, kMerge, {});
      ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
      EXPECT_EQ(fault_after(before, scene, report), "");
      // A tenth where a smaller hole does; to take one of two up moves half.
      const TopologyEvent& event = report.events[0];
      EXPECT_LT(event.volume_moved, (aspect == 1.0 ? 0.1 : 0.51) * event.volume_before)
          << aspect << " " << radius;
    }
}

TEST(Coalescence, DoesNotTakeUpADropThatHoldsAnother) {
  const double radius = 0.2 * kGap;
  const Vec3 center(1.0 + radius + 0.2 * kGap, 0, 0);
  const std::vector<SurfaceMesh> meshes{unit_sphere(Vec3::Zero()), sphere(42, radius, center),
                                        sphere(42, 0.3 * radius, center)};
  const Scene scene = scene_of(meshes, 400 / (4.0 * std::numbers::pi));
  const std::vector<Gap> gaps = find_gaps(scene, kGap, {});
  const auto outer = std::ranges::find_if(gaps, [](const Gap& gap) { return gap.a == 0; });
  ASSERT_NE(outer, gaps.end());
  EXPECT_NE(text_of(bridge_gap(scene, *outer, {kGap, 0.0}).fault), "");
}

/// A torus with a gap in it: a drop bent until its ends nearly meet, `gap` apart.
SurfaceMesh bent_drop(double gap) {
  SurfaceMesh mesh = stretched_sphere(1500, {3.0, 0.3, 0.3});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(remesh(mesh, {.C0 = 9.0}).ok());
  // The axis, 6 long, becomes an arc that leaves the gap open.
  const double radius = (6.0 + gap) / (2.0 * std::numbers::pi);
  for (Vec3& x : mesh.x) {
    const double angle = x.x() / radius, r = radius + x.y();
    x = Vec3(r * std::sin(angle), r * std::cos(angle), x.z());
  }
  return mesh;
}

TEST(Coalescence, ClosesABentDropToATorus) {
  const std::vector<SurfaceMesh> meshes{bent_drop(0.5 * kGap)};
  Scene scene = scene_of(meshes, 9.0);
  const Scene before = scene;
  ASSERT_EQ(text_of(find_conflict(scene)), "");
  const TopologyReport report = apply_topology(scene, kMerge, {});
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(scene.interfaces[0].drop, 1);
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 0);
}

TEST(Coalescence, ClosesTheHoleOfATorus) {
  SurfaceMesh mesh = test::torus(60, 24, 0.5, 0.494);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(remesh(mesh, {.C0 = 14.0}).ok());
  const std::vector<SurfaceMesh> meshes{mesh};
  Scene scene = scene_of(meshes, 9.0);
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, kMerge, {});
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  EXPECT_EQ(report.events[0].kind, EventKind::coalescence);
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 2);
}

TEST(Coalescence, PuncturesASheet) {
  // A disc with a dimple on either side, half a gap thick at its middle.
  SurfaceMesh mesh = stretched_sphere(1200, {1.0, 1.0, 0.2});
  RemeshOptions options{.C0 = 20.0};
  options.size_bound = [](const Vec3& x) { return 0.03 + 0.5 * std::hypot(x.x(), x.y()); };
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(remesh(mesh, options).ok());
  for (Vec3& x : mesh.x)
    x.z() *= 1.0 - (1.0 - 0.25 * kGap / 0.2) * std::exp(-6.0 * (x.x() * x.x() + x.y() * x.y()));
  const std::vector<SurfaceMesh> meshes{mesh};
  Scene scene = scene_of(meshes, 20.0);
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, kMerge, {});
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 0);
}

TEST(Coalescence, OfTheHoleToAPocketLeavesAVoid) {
  // A sphere with a pocket that a thin channel joins to the outside: made by opening the film
  // between a drop and a drop in it.
  const std::vector<SurfaceMesh> meshes{unit_sphere(Vec3::Zero()),
                                        sphere(200, 0.4, Vec3(0.6 - 0.9 * kGap, 0, 0))};
  const double inner_volume = enclosed_volume(meshes[1]);
  Scene scene = scene_of(meshes, 400 / (4.0 * std::numbers::pi));
  ASSERT_EQ(apply_topology(scene, kMerge, {}).events.size(), 1U);
  ASSERT_EQ(scene.interfaces.size(), 1U);
  const Scene before = scene;
  const SurfaceMesh& mesh = before.interfaces[0].mesh;
  const auto necks = find_necks(mesh, SurfaceTree(mesh), Side::outside, 0.26, {});
  ASSERT_EQ(necks.size(), 1U);
  Surgery surgery = cut_neck(mesh, necks[0]);
  ASSERT_EQ(text_of(surgery.fault), "");
  TopologyReport report;
  report.events.emplace_back();
  ASSERT_EQ(text_of(replace_interfaces(scene, {{0}, std::move(surgery.pieces)}, report.events[0])),
            "");
  report.events[0].area_after = 0.0;  // a wide channel closed by hand: no event of a run
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 2U);
  const bool is_first_outer = scene.interfaces[0].outside == RegionId{0};
  const Interface &outer = scene.interfaces[is_first_outer ? 0 : 1],
                  &pocket = scene.interfaces[is_first_outer ? 1 : 0];
  EXPECT_EQ(pocket.outside, outer.inside);
  EXPECT_NEAR(outer.volume - pocket.volume, before.interfaces[0].volume, 1e-12);
  // The drop that was let in, less about a dome of the width of the hole, a tenth of its radius
  // high.
  EXPECT_NEAR(pocket.volume, inner_volume, 0.06 * inner_volume);
  const RegionId matrix{0}, drop{1};
  RegionSources expected = sources_of({{matrix}, {}, {}});
  expected[outer.inside] = {drop};
  expected[pocket.inside] = {matrix};
  EXPECT_EQ(report.events[0].sources, expected);
}

TEST(Coalescence, DoesNotDependOnTheNumberingOfVertices) {
  const Scene scene = two_spheres(0.5 * kGap);
  std::vector<TopologyEvent> events;
  for (const unsigned seed : {0U, 6U, 7U}) {
    Scene other = scene;
    for (Interface& drop : other.interfaces)
      if (seed != 0U) drop.mesh = test::shuffled(drop.mesh, seed);
    const TopologyReport report = apply_topology(other, kMerge, {});
    ASSERT_EQ(report.events.size(), 1U);
    events.push_back(report.events[0]);
  }
  for (std::size_t k = 1; k < events.size(); ++k) {
    EXPECT_LT((events[k].position - events[0].position).norm(), 1e-12);
    EXPECT_NEAR(*events[k].gap, *events[0].gap, 1e-12);
  }
}

/// Two spheres, dimpled where they face each other: `ring` apart on a ring of that radius, where
/// they are closest, and `middle` in its middle.
Scene two_dimpled_spheres(double radius, double ring, double middle) {
  const double sagitta = 1.0 - std::sqrt(1.0 - radius * radius);
  Scene scene = two_spheres(ring - 2.0 * sagitta);
  for (Interface& drop : scene.interfaces) {
    const double side = enclosed_centroid(drop.mesh).x() < 0.0 ? -1.0 : 1.0;
    RemeshOptions options{.C0 = drop.C0};
    options.size_bound = [&](const Vec3& x) {
      return 0.02 + 0.5 * std::max(0.0, std::hypot(x.x(), x.y(), x.z()) - 1.2 * radius);
    };
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(remesh(drop.mesh, options).ok());
    for (Vec3& x : drop.mesh.x) {
      const double share = (x.y() * x.y() + x.z() * x.z()) / (radius * radius);
      if (share < 1.0 && side * x.x() < 0.5)
        x.x() = 0.5 * side * (ring + (middle - ring) * std::pow(1.0 - share, 2));
    }
    drop.volume = enclosed_volume(drop.mesh);
  }
  EXPECT_EQ(text_of(find_conflict(scene)), "");
  return scene;
}

bool is_enclosed(const Scene& scene, const Vec3& x) {
  return std::ranges::any_of(
      scene.interfaces, [&](const Interface& drop) { return encloses(SurfaceTree(drop.mesh), x); });
}

TEST(Coalescence, TakesOutAFilmThatItWouldTrap) {
  // The film within the ring has a volume of about 2e-4, that of a sphere of radius 0.037, less
  // than two limits.
  Scene scene = two_dimpled_spheres(0.1, 0.7 * kGap, 1.2 * kGap);
  ASSERT_FALSE(is_enclosed(scene, Vec3::Zero()));
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, kMerge, {});
  ASSERT_EQ(report.events.size(), 1U) << (report.warnings.empty() ? "" : report.warnings[0]);
  EXPECT_EQ(fault_after(before, scene, report), "");
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 2);
  EXPECT_TRUE(is_enclosed(scene, Vec3::Zero()));
}

TEST(Coalescence, LeavesAFilmThatCanBeResolvedWithinARing) {
  // The film's volume is that of a sphere of radius 0.09, more than four limits: bridges are built
  // along the ring, and the film drains between them.
  constexpr double kRing = 0.15;
  Scene scene = two_dimpled_spheres(kRing, 0.7 * kGap, 6.0 * kGap);
  const Scene before = scene;
  const TopologyReport report = apply_topology(scene, kMerge, {});
  ASSERT_GE(report.events.size(), 2U);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(fault_after(before, scene, report), "");
  for (const TopologyEvent& event : report.events)
    EXPECT_NEAR(std::hypot(event.position.y(), event.position.z()), kRing, 0.01);
  ASSERT_EQ(scene.interfaces.size(), 1U);
  const auto num_bridges = static_cast<int>(report.events.size());
  EXPECT_EQ(euler_characteristic(scene.interfaces[0].mesh), 4 - 2 * num_bridges);
  EXPECT_FALSE(is_enclosed(scene, Vec3::Zero()));
  const SurfaceTree tree(scene.interfaces[0].mesh);
  EXPECT_GT(tree.closest(Vec3::Zero()).distance, 2.5 * kGap);  // three limits: half the film
}

}  // namespace
}  // namespace meniscus
