// Fields on interfaces and in the bulk, carried through whole steps.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/evolve/cosine_fields.hpp"
#include "tests/evolve/prescribed_flow.hpp"

namespace meniscus {
namespace {

using test::Amounts, test::amounts, test::cosines, test::expect_kept, test::put_cosines, test::step;

void add_drop(Scene& scene, int nodes, double radius, const Vec3& at) {
  Interface drop;
  drop.drop = static_cast<int>(scene.interfaces.size());
  drop.mesh = sphere(nodes, radius);
  for (Vec3& x : drop.mesh.x) x += at;
  drop.C0 = nodes / (4.0 * std::numbers::pi);
  drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
  scene.interfaces.push_back(std::move(drop));
  scene.liquids.add({});
}

Scene in_sphere(double radius) {
  Scene scene;
  scene.liquids.add({});
  scene.boundary.mesh = sphere(60, radius);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  scene.boundary.patches.add({"wall", NoPenetration{}});
  return scene;
}

/// A drop turned and stretched to and fro by a shear.
struct Sheared {
  PrescribedFlow* flow;
  Evolution evolution;
};
Sheared sheared_drop(double end) {
  Scene scene = in_sphere(4.0);
  add_drop(scene, 60, 1.0, Vec3::Zero());
  assign_regions(scene);
  EvolutionOptions options;
  options.end = end;
  options.max_step = 0.02;
  options.min_step = 1e-4;
  auto flow = std::make_unique<PrescribedFlow>([](const Vec3& x, double t) {
    return Vec3(std::cos(2.0 * t) * x.y(), 0.3 * std::sin(3.0 * t) * x.x(), 0.0);
  });
  PrescribedFlow* seen = flow.get();
  return {seen, Evolution(scene, options, std::move(flow),
                          MovingMesh({.tetrahedra = {}, .motion = VolumeMotion::harmonic}))};
}

TEST(CarriedFields, KeepTheirAmountsThroughRemeshedSteps) {
  Evolution evolution = sheared_drop(10.0).evolution;
  ASSERT_TRUE(evolution.prepare().ok());
  put_cosines(evolution);
  const Amounts before = amounts(evolution.state());
  for (int i = 0; i < 200; ++i) step(evolution);
  expect_kept(amounts(evolution.state()), before, 1e-12);
  const auto [low, high] =
      std::ranges::minmax(evolution.scene().interfaces[0].fields.on_vertices[1].values);
  EXPECT_GE(low, 1.0);
  EXPECT_LE(high, 3.0);
  EXPECT_LT(low, 2.0);  // it is still no constant
  EXPECT_GT(high, 2.0);
  const auto& temperature = evolution.state().mesh->fields().on_vertices[0].values;
  EXPECT_GE(std::ranges::min(temperature), 1.0);
  EXPECT_LE(std::ranges::max(temperature), 3.0);
  std::printf("excess %.3e above, %.3e below; kept to %.1e %.1e %.1e\n",
              evolution.state().field_excess.above, evolution.state().field_excess.below,
              amounts(evolution.state()).on_vertices / before.on_vertices - 1.0,
              amounts(evolution.state()).on_faces / before.on_faces - 1.0,
              amounts(evolution.state()).in_cells[1] / before.in_cells[1] - 1.0);
}

TEST(CarriedFields, AreAsTheyWereAfterARefusedStep) {
  log::set_level(log::Level::off);
  Sheared run = sheared_drop(10.0);
  ASSERT_TRUE(run.evolution.prepare().ok());
  put_cosines(run.evolution);
  step(run.evolution);
  ASSERT_TRUE(run.evolution.solve().ok());
  const SurfaceFields on_interface = run.evolution.scene().interfaces[0].fields;
  const VolumeFields in_bulk = run.evolution.state().mesh->fields();
  run.flow->longest_step = 0.0;
  EXPECT_FALSE(run.evolution.advance().ok());
  EXPECT_EQ(run.evolution.scene().interfaces[0].fields, on_interface);
  EXPECT_EQ(run.evolution.state().mesh->fields(), in_bulk);
  log::set_level(log::Level::warning);
}

TEST(CarriedFields, GoOnFromACheckpointToTheSameBits) {
  Evolution whole = sheared_drop(10.0).evolution;
  ASSERT_TRUE(whole.prepare().ok());
  put_cosines(whole);
  for (int i = 0; i < 3; ++i) step(whole);
  Archive archive;
  whole.save(archive);
  Evolution resumed = sheared_drop(10.0).evolution;
  resumed.load(archive);
  for (int i = 0; i < 3; ++i) {
    step(whole);
    step(resumed);
  }
  EXPECT_EQ(whole.scene().interfaces[0].fields, resumed.scene().interfaces[0].fields);
  EXPECT_EQ(whole.state().mesh->fields(), resumed.state().mesh->fields());
  Archive a, b;
  whole.save(a);
  resumed.save(b);
  EXPECT_EQ(a.reals, b.reals);
  archive.reals["interfaces/0/fields/faces/0/values"].pop_back();
  EXPECT_THROW(sheared_drop(10.0).evolution.load(archive), InvalidInput);
}

EvolutionOptions merging() {
  EvolutionOptions options;
  options.end = 10.0;
  options.max_step = 0.02;
  options.min_step = 1e-4;
  options.edge_floor = 0.02;
  options.topology = {
      .breakup_radius = 0.04, .coalescence = true, .coalescence_gap = 0.05, .edge_floor = 0.02};
  return options;
}

// Two drops meet: what both carried is on and in the one they become.
TEST(CarriedFields, AddUpWhereDropsMerge) {
  Scene scene = in_sphere(3.0);
  add_drop(scene, 100, 0.5, Vec3(-0.56, 0, 0));
  add_drop(scene, 100, 0.5, Vec3(0.56, 0, 0));
  assign_regions(scene);
  Evolution evolution(scene, merging(), std::make_unique<PrescribedFlow>([](const Vec3& x, double) {
                        return Vec3(x.x() < 0.0 ? 1.0 : -1.0, 0.0, 0.0);
                      }),
                      MovingMesh({.tetrahedra = {}, .motion = VolumeMotion::harmonic}));
  ASSERT_TRUE(evolution.prepare().ok());
  put_cosines(evolution);
  const Amounts before = amounts(evolution.state());
  for (int i = 0; i < 100 && evolution.events().empty(); ++i) step(evolution);
  ASSERT_EQ(evolution.events().size(), 1U);
  ASSERT_EQ(evolution.scene().interfaces.size(), 1U);
  // Of the two drops in the one that they became.
  const Amounts both{before.on_vertices,
                     before.on_faces,
                     {before.in_cells[0], before.in_cells[1] + before.in_cells[2]}};
  expect_kept(amounts(evolution.state()), both, 1e-12);
}

// A drop within a drop comes to its surface and opens to the liquid around, which takes what it
// held; the outer drop keeps what is its own.
TEST(CarriedFields, GoToTheMatrixWithADropThatIsReleased) {
  Scene scene = in_sphere(3.0);
  add_drop(scene, 200, 1.0, Vec3::Zero());
  add_drop(scene, 100, 0.4, Vec3(0.5, 0, 0));
  assign_regions(scene);
  ASSERT_EQ(scene.interfaces[1].outside, scene.interfaces[0].inside);
  Evolution evolution(scene, merging(), std::make_unique<PrescribedFlow>([](const Vec3& x, double) {
                        return Vec3(x.norm() < 0.97 ? 1.0 : 0.0, 0.0, 0.0);
                      }),
                      MovingMesh({.tetrahedra = {}, .motion = VolumeMotion::harmonic}));
  ASSERT_TRUE(evolution.prepare().ok());
  put_cosines(evolution);
  const Amounts before = amounts(evolution.state());
  for (int i = 0; i < 100 && evolution.events().empty(); ++i) step(evolution);
  ASSERT_EQ(evolution.events().size(), 1U);
  ASSERT_EQ(evolution.scene().interfaces.size(), 1U);
  const Amounts expected{before.on_vertices,
                         before.on_faces,
                         {before.in_cells[0] + before.in_cells[2], before.in_cells[1]}};
  expect_kept(amounts(evolution.state()), expected, 1e-12);
}

std::string refusal(auto&& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(CarriedFields, ThatDoNotFitAreRefusedByName) {
  Evolution evolution = sheared_drop(1.0).evolution;
  ASSERT_TRUE(evolution.prepare().ok());
  const SurfaceFields good = cosines(evolution.scene().interfaces[0].mesh);
  SurfaceFields wrong = good;
  wrong.on_vertices[0].values.add(1.0);
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({wrong}); }).find("gamma"),
            std::string::npos);
  wrong = good;
  wrong.on_faces[0].values[FaceId{3}] = std::nan("");
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({wrong}); }).find("load"),
            std::string::npos);
  wrong = good;
  wrong.on_vertices[1].name = "gamma";
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({wrong}); }).find("gamma"),
            std::string::npos);
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({good, good}); }), "");
  EXPECT_TRUE(evolution.scene().interfaces[0].fields.empty());
}

}  // namespace
}  // namespace meniscus
