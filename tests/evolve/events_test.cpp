#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include <gtest/gtest.h>

#include "meniscus/core/log.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/evolve/prescribed_flow.hpp"

namespace meniscus {
namespace {

/// Two drops on the x-axis.
Scene two_drops() {
  Scene scene;
  scene.is_unbounded = true;
  scene.liquids.add({});
  for (const double x : {-0.56, 0.56}) {
    Interface drop;
    drop.drop = static_cast<int>(scene.interfaces.size());
    drop.mesh = sphere(100, 0.5, Vec3(x, 0, 0));
    drop.C0 = 100 / 12.566;
    drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
    scene.interfaces.push_back(std::move(drop));
    scene.liquids.add({});
  }
  assign_regions(scene);
  return scene;
}

Evolution evolution_of(const Scene& scene, bool coalescence,
                       std::optional<MovingMesh> mesh = std::nullopt) {
  EvolutionOptions options;
  options.end = 10.0;
  options.max_step = 0.02;
  options.min_step = 1e-4;
  options.edge_floor = 0.02;
  options.topology = {.breakup_radius = 0.04,
                      .coalescence = coalescence,
                      .coalescence_gap = coalescence ? 0.05 : 0.0,
                      .edge_floor = 0.02};
  auto flow = std::make_unique<PrescribedFlow>([](const Vec3& x, double) {
    return Vec3(x.x() < 0.0 ? 1.0 : -1.0, 0.0, 0.0);  // toward each other, as they are
  });
  return {scene, options, std::move(flow), std::move(mesh)};
}

/// Steps until something has happened, at most `count`; the last report.
Report run(Evolution& evolution, int count) {
  Report report = evolution.prepare();
  for (int i = 0; report.ok() && i < count && evolution.events().empty(); ++i) {
    report = evolution.solve();
    if (report.ok()) report = evolution.advance();
  }
  return report;
}

TEST(EvolutionEvents, MergeDropsThatMeetAndGoOn) {
  Evolution evolution = evolution_of(two_drops(), true);
  const Report report = run(evolution, 100);
  ASSERT_TRUE(report.ok()) << report.text();
  ASSERT_EQ(evolution.events().size(), 1U);
  const TopologyEvent& event = evolution.events()[0];
  EXPECT_EQ(event.kind, EventKind::coalescence);
  EXPECT_EQ(evolution.scene().interfaces.size(), 1U);
  EXPECT_EQ(evolution.drop_rows().size(), 1U);
  EXPECT_EQ(evolution.drop_rows()[0].drop, 2);
  EXPECT_NEAR(event.volume_after, event.volume_before, 1e-12 * event.volume_before);
  ASSERT_TRUE(evolution.solve().ok());
  const Report next = evolution.advance();
  ASSERT_TRUE(next.ok()) << next.text();
  EXPECT_TRUE(evolution.events().empty());
}

Interface distant_drop(int id) {
  Interface drop;
  drop.drop = id;
  drop.mesh = stretched_sphere(100, Vec3(0.7, 0.5, 0.4));
  for (Vec3& x : drop.mesh.x) x += Vec3(-3.0, 4.0, 0.0);
  drop.C0 = 100 / 12.566;
  drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
  return drop;
}

// A drop that has no part in an event goes on as if it were alone.
TEST(EvolutionEvents, LeaveOtherDropsAlone) {
  Scene together = two_drops(), alone = together;
  together.interfaces.insert(together.interfaces.begin(), distant_drop(2));
  alone.interfaces.assign(1, distant_drop(2));
  together.liquids.add({});
  alone.liquids.resize(2);
  assign_regions(together);
  assign_regions(alone);
  Evolution evolution = evolution_of(together, true), other = evolution_of(alone, true);
  ASSERT_TRUE(run(evolution, 100).ok());
  ASSERT_EQ(evolution.events().size(), 1U);
  ASSERT_TRUE(other.prepare().ok());
  while (other.step() < evolution.step()) {
    ASSERT_TRUE(other.solve().ok());
    ASSERT_TRUE(other.advance().ok());
  }
  ASSERT_EQ(other.t(), evolution.t());
  ASSERT_EQ(evolution.scene().interfaces[0].drop, 2);
  EXPECT_EQ(evolution.scene().interfaces[0].mesh, other.scene().interfaces[0].mesh);
  EXPECT_EQ(evolution.drop_rows()[0].volume_correction, other.drop_rows()[0].volume_correction);
}

TEST(EvolutionEvents, ArePartOfTheCheckpointAfterThem) {
  Evolution evolution = evolution_of(two_drops(), true);
  ASSERT_TRUE(run(evolution, 100).ok());
  ASSERT_EQ(evolution.events().size(), 1U);
  Archive archive;
  evolution.save(archive);
  Evolution again = evolution_of(two_drops(), true);
  again.load(archive);
  ASSERT_EQ(again.events().size(), 1U);
  const TopologyEvent &a = evolution.events()[0], &b = again.events()[0];
  EXPECT_EQ(a.parents, b.parents);
  EXPECT_EQ(a.children, b.children);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.neck_radius, b.neck_radius);
  EXPECT_EQ(a.energy_after, b.energy_after);
  EXPECT_EQ(again.scene().liquids.size(), 2);
  EXPECT_EQ(again.scene().interfaces[0].mesh, evolution.scene().interfaces[0].mesh);
}

/// A mesh of the interfaces' vertices alone, without a cell, for two drops or more.
MovingMesh mesh_of_two_drops() {
  return {VolumeMotion::spines, [](const Scene& scene, const TetMesh&, TetMesh& mesh) {
            if (scene.interfaces.size() < 2)
              return VolumeMeshReport{{Fault{FaultKind::mesher, "too few drops"}}};
            mesh = {};
            for (const Interface& interface : scene.interfaces) {
              mesh.interfaces.push_back(
                  {TetVertexId{mesh.num_vertices()}, interface.mesh.num_vertices(), {}});
              for (const Vec3& x : interface.mesh.x) mesh.x.add(x);
            }
            mesh.boundary.first_vertex = TetVertexId{mesh.num_vertices()};
            return VolumeMeshReport{};
          }};
}

// The liquids around the merged drop have no mesh: no step can be taken. Neither the drops nor the
// list of events, which the last checkpoint holds, may show the merger that was tried.
TEST(EvolutionEvents, AreTakenBackWithTheStepTheyFail) {
  log::set_level(log::Level::off);
  Evolution evolution = evolution_of(two_drops(), true, mesh_of_two_drops());
  const Report report = run(evolution, 100);
  log::set_level(log::Level::warning);
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.text().find("too few drops"), std::string::npos) << report.text();
  EXPECT_GT(evolution.step(), 0);
  EXPECT_EQ(evolution.scene().interfaces.size(), 2U);
  EXPECT_EQ(evolution.drop_rows().size(), 2U);
  EXPECT_TRUE(evolution.events().empty());
  Archive archive;
  evolution.save(archive);
  Evolution again = evolution_of(two_drops(), true, mesh_of_two_drops());
  again.load(archive);
  EXPECT_TRUE(again.events().empty());
}

TEST(EvolutionEvents, RefusesToLetDropsTouchWithoutCoalescence) {
  Evolution evolution = evolution_of(two_drops(), false);
  const Report report = run(evolution, 100);
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.text().find("drops 0 and 1 touch"), std::string::npos) << report.text();
  EXPECT_NE(report.text().find("topology.coalescence = \"off\""), std::string::npos);
  EXPECT_EQ(evolution.scene().interfaces.size(), 2U);
}

/// A thread bent round so far that its ends look at each other across a mouth at x < 0.
Scene bent_drop() {
  constexpr double kRadius = 1.0;
  Interface drop;
  drop.C0 = 40 / 12.566;
  drop.mesh = stretched_sphere(300, Vec3(3.0, 0.4, 0.4));
  for (Vec3& x : drop.mesh.x) {
    const double angle = x.x() / kRadius, r = kRadius - x.y();
    x = Vec3(r * std::cos(angle), r * std::sin(angle), x.z());
  }
  drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
  Scene scene;
  scene.is_unbounded = true;
  scene.liquids.add({});
  scene.interfaces.push_back(std::move(drop));
  scene.liquids.add({});
  assign_regions(scene);
  return scene;
}

/// The mouth closed by force, remeshed every so many steps, or as needed (0): the surface never
/// touches itself. Without any change of topology the last report says that it would.
Report closed_mouth(int remesh_every, double breakup_radius) {
  EvolutionOptions options;
  options.max_step = 0.02;
  options.min_step = 1e-3;
  options.remesh_every = remesh_every;
  options.topology = {.breakup_radius = breakup_radius, .coalescence = false};
  Evolution evolution(bent_drop(), options,
                      std::make_unique<PrescribedFlow>([](const Vec3& x, double) {
                        const double share = std::clamp(-x.x(), 0.0, 0.5);
                        return Vec3(0.0, x.y() < 0.0 ? share : -share, 0.0);
                      }));
  Report report = evolution.prepare();
  for (int i = 0; report.ok() && i < 60; ++i) {
    report = evolution.solve();
    if (report.ok()) report = evolution.advance();
    EXPECT_EQ(text_of(find_self_intersection(evolution.scene().interfaces[0].mesh)), "");
  }
  return report;
}

TEST(EvolutionEvents, RefuseToLetADropTouchItselfWithoutCoalescence) {
  std::ignore = closed_mouth(1, 0.01);
  std::ignore = closed_mouth(1000, 0.01);
  std::ignore = closed_mouth(0, 0.01);
  for (const int remesh_every : {0, 1, 1000}) {
    const Report report = closed_mouth(remesh_every, 0.0);
    ASSERT_FALSE(report.ok()) << remesh_every;
    EXPECT_NE(report.text().find("drop 0 touches itself"), std::string::npos) << report.text();
    EXPECT_NE(report.text().find("topology.coalescence = \"off\""), std::string::npos);
  }
}

TEST(EvolutionEvents, StopAtOnceWhereUnlikeDropsWouldMerge) {
  Scene scene = two_drops();
  scene.liquids[RegionId{2}].viscosity = 2.0;
  Evolution evolution = evolution_of(scene, true);
  const Report report = run(evolution, 100);
  ASSERT_FALSE(report.ok());
  ASSERT_TRUE(report.fault);
  EXPECT_EQ(report.fault->kind, FaultKind::unlike_liquids);
  EXPECT_NE(report.text().find("unlike"), std::string::npos) << report.text();
}

}  // namespace
}  // namespace meniscus
