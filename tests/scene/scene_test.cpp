#include "meniscus/scene/scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

Scene scene_within(TaggedSurface boundary, int num_patches) {
  Scene scene;
  scene.boundary.mesh = std::move(boundary.mesh);
  for (const int tag : boundary.tag) scene.boundary.patch.add(PatchId{tag});
  for (int i = 0; i < num_patches; ++i) scene.boundary.patches.add({"side", NoPenetration{}});
  scene.liquids.add({});
  return scene;
}

Scene boxed() { return scene_within(box(98, Vec3(5.0, 4.0, 3.0)), 6); }

void add_drop(Scene& scene, SurfaceMesh mesh, RegionId outside = RegionId{0}) {
  Interface drop;
  drop.drop = 10 + static_cast<int>(scene.interfaces.size());
  drop.inside = RegionId{static_cast<std::int32_t>(scene.interfaces.size()) + 1};
  drop.outside = outside;
  drop.mesh = std::move(mesh);
  scene.interfaces.push_back(std::move(drop));
}

void expect_conflict(const Scene& scene, const std::vector<std::string>& words) {
  const std::string conflict = text_of(find_conflict(scene));
  for (const std::string& word : words)
    EXPECT_NE(conflict.find(word), std::string::npos) << "'" << word << "' in '" << conflict << "'";
}

TEST(FindConflict, PassesSoundScenes) {
  Scene scene = boxed();
  EXPECT_EQ(text_of(find_conflict(scene)), "");
  add_drop(scene, sphere(100, 1.0, Vec3(-2.0, 0, 0)));
  add_drop(scene, sphere(80, 1.5, Vec3(2.0, 0, 0)));
  add_drop(scene, sphere(60, 0.5, Vec3(2.3, 0, 0)), RegionId{2});
  add_drop(scene, sphere(42, 0.2, Vec3(2.3, 0, 0)), RegionId{3});
  add_drop(scene, sphere(42, 0.2, Vec3(1.3, 0, 0)), RegionId{2});
  EXPECT_EQ(text_of(find_conflict(scene)), "");
}

TEST(FindConflict, NamesDropsThatTouch) {
  Scene scene = boxed();
  add_drop(scene, sphere(100, 1.0, Vec3(0.0, 1.0, 0)));
  add_drop(scene, sphere(100, 0.8, Vec3(0.0, -0.75, 0)));
  expect_conflict(scene, {"drops 10 and 11 touch", "near (", "face"});
  scene.is_unbounded = true;
  expect_conflict(scene, {"drops 10 and 11 touch"});
}

TEST(FindConflict, NamesDropsAtTheBoundary) {
  Scene through = boxed();
  add_drop(through, sphere(100, 1.0, Vec3(4.5, 0, 0)));
  expect_conflict(through, {"drop 10 touches the outer boundary", "near ("});
  Scene touching = boxed();
  add_drop(touching, box(98, Vec3::Constant(1.0)).mesh);
  for (Vec3& x : touching.interfaces[0].mesh.x) x.z() += 2.0;  // a face in the wall
  expect_conflict(touching, {"drop 10 touches the outer boundary"});
  Scene outside = boxed();
  add_drop(outside, sphere(100, 1.0, Vec3(0.0, 8.0, 0)));
  expect_conflict(outside, {"drop 10 lies outside the outer boundary, at ("});
  outside.is_unbounded = true;
  EXPECT_EQ(text_of(find_conflict(outside)), "");
}

TEST(FindConflict, RefusesWhatIsNotFinite) {
  Scene scene = boxed();
  add_drop(scene, sphere(100));
  scene.interfaces[0].mesh.x[VertexId{3}].z() = std::nan("");
  expect_conflict(scene, {"drop 10", "not finite"});
  scene.interfaces[0].mesh = {};
  expect_conflict(scene, {"drop 10", "no surface"});
}

TEST(FindConflict, ComparesNestingWithRegions) {
  Scene scene = boxed();
  add_drop(scene, sphere(100, 1.5));
  add_drop(scene, sphere(60, 0.5), RegionId{0});
  expect_conflict(scene, {"drop 11", "lies in region 1, not in region 0"});
  scene.interfaces[1].outside = RegionId{1};
  EXPECT_EQ(text_of(find_conflict(scene)), "");
  scene.interfaces[0].inside = RegionId{2};
  expect_conflict(scene, {"drop 10", "encloses region 1"});
  Scene apart = boxed();
  add_drop(apart, sphere(100, 1.0, Vec3(-2.0, 0, 0)));
  add_drop(apart, sphere(60, 0.5, Vec3(2.0, 0, 0)), RegionId{1});
  expect_conflict(apart, {"drop 11", "lies in region 0, not in region 1"});
}

TEST(ImposedFlux, OfLinearFlowsVanishesOnAnyClosedBoundary) {
  Scene scene = scene_within(cylinder(300, 1.5, 4.0), 3);
  scene.flow =
      ImposedFlow(FlowFamily::general, Mat3{{0.3, 1.0, 0.2}, {-0.5, 0.4, 0.1}, {0.7, -0.9, -0.7}});
  for (Patch& patch : scene.boundary.patches)
    patch.condition =
        ImposedVelocity{[&](const Vec3& x, double t) { return scene.flow.velocity(x, t); }, true};
  // Roundoff of a sum over 600 faces of terms up to 4 · area.
  EXPECT_NEAR(imposed_flux(scene, 0.0), 0.0, 1e-12);
}

TEST(ImposedFlux, IsExactForLinearDataAndCountsImposedPatchesOnly) {
  Scene scene = boxed();
  const auto set = [&](int side, auto&& velocity) {
    scene.boundary.patches[PatchId{side}].condition = ImposedVelocity{velocity};
  };
  EXPECT_EQ(imposed_flux(scene, 1.0), 0.0);
  // On the side +x (of area 8 × 6, n = x): v = t (2 + y + 3z) integrates to 2 t · 48.
  set(1, [](const Vec3& x, double t) { return Vec3(t * (2.0 + x.y() + 3.0 * x.z()), 7.0, 7.0); });
  EXPECT_NEAR(imposed_flux(scene, 0.5), 48.0, 1e-12);
  // Out through −x as much as in through +x.
  set(0, [](const Vec3&, double t) { return Vec3(2.0 * t, 0.0, 0.0); });
  EXPECT_NEAR(imposed_flux(scene, 0.5), 0.0, 1e-12);
  EXPECT_FALSE(has_open_patch(scene));
  scene.boundary.patches[PatchId{4}].condition = ImposedTraction{Vec3(0, 0, 1)};
  EXPECT_TRUE(has_open_patch(scene));
}

TEST(ImposedFlow, FollowsItsSchedule) {
  ImposedFlow flow(FlowFamily::planar, ImposedFlow::simple_shear());
  flow.add({1.0, 0.5, Mat3::Zero()});
  flow.add({3.0, 0.0, 2.0 * ImposedFlow::planar_extension()});
  EXPECT_EQ(flow.gradient(0.0), ImposedFlow::simple_shear());
  EXPECT_EQ(flow.gradient(0.999), ImposedFlow::simple_shear());
  EXPECT_LT((flow.gradient(1.25) - 0.5 * ImposedFlow::simple_shear()).norm(), 1e-15);
  EXPECT_EQ(flow.gradient(2.0), Mat3(Mat3::Zero()));
  EXPECT_EQ(flow.gradient(3.0), 2.0 * ImposedFlow::planar_extension());
  EXPECT_EQ(flow.velocity(Vec3(1, 2, 3), 0.0), Vec3(2, 0, 0));
  for (const Mat3& g : {ImposedFlow::simple_shear(), ImposedFlow::uniaxial_extension(),
                        ImposedFlow::planar_extension()})
    EXPECT_EQ(g.trace(), 0.0);
}

}  // namespace
}  // namespace meniscus
