#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/surface/repair/mend.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

using enum FieldTransfer;

constexpr double kC0 = 9.0;

Vec3 center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

double wave(const Vec3& x) { return std::cos(2.0 * x.x() + x.y()); }

/// The wave on vertices and on faces, interpolated first and conserved second.
SurfaceFields waves(const SurfaceMesh& mesh) {
  SurfaceFields fields;
  for (const FieldTransfer transfer : {interpolated, conserved}) {
    auto& on_vertices = fields.on_vertices.emplace_back();
    auto& on_faces = fields.on_faces.emplace_back();
    on_vertices.name = on_faces.name = transfer == conserved ? "amount" : "colour";
    on_vertices.transfer = on_faces.transfer = transfer;
    for (const Vec3& x : mesh.x) on_vertices.values.add(wave(x));
    for (const FaceId f : mesh.faces.ids()) on_faces.values.add(wave(center(mesh, f)));
  }
  return fields;
}

/// ∮ f dS of what is conserved, and ∮ |f| dS.
struct Amounts {
  double on_vertices = 0.0, on_faces = 0.0, size = 0.0;
};
void add_amounts(const SurfaceMesh& mesh, const SurfaceFields& fields, Amounts& amounts) {
  ASSERT_EQ(fields.on_vertices[1].values.size(), mesh.num_vertices());
  ASSERT_EQ(fields.on_faces[1].values.size(), mesh.num_faces());
  const VertexField<double> areas = vertex_areas(mesh);
  for (const VertexId v : areas.ids()) {
    amounts.on_vertices += areas[v] * fields.on_vertices[1].values[v];
    amounts.size += areas[v] * std::abs(fields.on_vertices[1].values[v]);
  }
  for (const FaceId f : mesh.faces.ids())
    amounts.on_faces += face_area_vector(mesh, f).norm() * fields.on_faces[1].values[f];
}
Amounts amounts_of(const Scene& scene) {
  Amounts amounts;
  for (const Interface& drop : scene.interfaces) add_amounts(drop.mesh, drop.fields, amounts);
  return amounts;
}

void expect_same(const Amounts& after, const Amounts& before) {
  EXPECT_NEAR(after.on_vertices, before.on_vertices, 1e-12 * before.size);
  EXPECT_NEAR(after.on_faces, before.on_faces, 1e-12 * before.size);
}

/// The range of the wave is |f| ≤ 1. Interpolated fields never leave it, conserved ones by the
/// excess.
void expect_in_range(const SurfaceFields& fields, const FieldExcess& excess) {
  const auto expect = [](const auto& field, double above, double below) {
    const auto [low, high] = std::ranges::minmax(field.values);
    EXPECT_LE(high, 1.0 + above) << field.name;
    EXPECT_GE(low, -1.0 - below) << field.name;
  };
  expect(fields.on_vertices[0], 0.0, 0.0);
  expect(fields.on_faces[0], 0.0, 0.0);
  expect(fields.on_vertices[1], excess.above, excess.below);
  expect(fields.on_faces[1], excess.above, excess.below);
}

void record(const FieldExcess& excess) {
  testing::Test::RecordProperty("excess_above", fmt::format("{:.3e}", excess.above));
  testing::Test::RecordProperty("excess_below", fmt::format("{:.3e}", excess.below));
}

Scene carrying(Scene scene) {
  for (Interface& drop : scene.interfaces) drop.fields = waves(drop.mesh);
  return scene;
}

/// Amounts, ranges, and that everything but the fields is what it is without them.
void expect_carried(const Scene& bare, const TopologyOptions& options) {
  Scene without = bare, scene = carrying(bare);
  const Amounts before = amounts_of(scene);
  ASSERT_EQ(apply_topology(without, options, {}).events.size(), 1U);
  const TopologyReport report = apply_topology(scene, options, {});
  ASSERT_EQ(report.events.size(), 1U);
  ASSERT_EQ(scene.interfaces.size(), without.interfaces.size());
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    EXPECT_EQ(scene.interfaces[i].mesh, without.interfaces[i].mesh);
  expect_same(amounts_of(scene), before);
  // One after the other.
  FieldExcess excess = report.events[0].field_excess;
  excess.above += report.finishing_excess.above;
  excess.below += report.finishing_excess.below;
  record(excess);
  for (const Interface& drop : scene.interfaces) expect_in_range(drop.fields, excess);
  EXPECT_LT(std::max(excess.above, excess.below), 0.2);
}

Scene dumbbell() {
  const std::vector<SurfaceMesh> meshes{test::wavy_thread(2.0, 0.5, 4, -0.9, 1, kC0)};
  return test::scene_of(meshes, kC0);
}

Scene two_spheres(double gap) {
  constexpr double kDensity = 400 / (4.0 * std::numbers::pi);
  std::vector<SurfaceMesh> meshes;
  for (const double side : {-1.0, 1.0}) {
    meshes.push_back(sphere(400, 1.0, Vec3(side * (1.0 + gap / 2.0), 0, 0)));
    EXPECT_TRUE(remesh(meshes.back(), {.C0 = kDensity}).ok());
  }
  return test::scene_of(meshes, kDensity);
}

TEST(CarriedFields, GoThroughACut) { expect_carried(dumbbell(), {.breakup_radius = 0.06}); }

TEST(CarriedFields, GoThroughABridge) {
  expect_carried(two_spheres(0.01), {.coalescence = true, .coalescence_gap = 0.02});
}

const Surfactant kCovered{LinearState{0.2}, 0.1};

Scene covered(Scene scene) {
  for (Interface& drop : scene.interfaces) {
    drop.surfactant = kCovered;
    auto& field = drop.fields.on_vertices.emplace_back();
    field.name = kSurfactantField;
    field.transfer = conserved;
    for (const Vec3& x : drop.mesh.x) field.values.add(1.0 + 0.2 * x.x());
  }
  return scene;
}

/// Σ Γ_v S_v over the vertices of a drop on one side of x = 0, a third at a time of each face.
double amount(const Interface& drop, double side = 0.0) {
  const VertexField<double>& concentration = *surfactant_concentration(drop);
  double sum = 0.0;
  for (const FaceId f : drop.mesh.faces.ids()) {
    if (side * center(drop.mesh, f).x() < 0.0) continue;
    for (const VertexId v : drop.mesh.faces[f])
      sum += face_area_vector(drop.mesh, f).norm() / 3.0 * concentration[v];
  }
  return sum;
}

TEST(Surfactants, GoToTheChildrenOfACut) {
  Scene scene = covered(dumbbell());
  const Interface parent = scene.interfaces[0];
  ASSERT_EQ(apply_topology(scene, {.breakup_radius = 0.06}, {}).events.size(), 1U);
  ASSERT_EQ(scene.interfaces.size(), 2U);
  double sum = 0.0;
  for (const Interface& child : scene.interfaces) {
    EXPECT_EQ(child.surfactant, kCovered);
    sum += amount(child);
    const double side = child.mesh.x[VertexId{0}].x();
    EXPECT_NEAR(amount(child) / amount(parent, side), 1.0, 0.005);
  }
  EXPECT_NEAR(sum / amount(parent), 1.0, 1e-12);
}

TEST(Surfactants, OfDropsThatMergeAddUp) {
  Scene scene = covered(two_spheres(0.01));
  const double before = amount(scene.interfaces[0]) + amount(scene.interfaces[1]);
  const TopologyOptions options{.coalescence = true, .coalescence_gap = 0.02};
  ASSERT_EQ(apply_topology(scene, options, {}).events.size(), 1U);
  ASSERT_EQ(scene.interfaces.size(), 1U);
  EXPECT_EQ(scene.interfaces[0].surfactant, kCovered);
  EXPECT_NEAR(amount(scene.interfaces[0]) / before, 1.0, 1e-12);
}

TEST(Surfactants, ThatDifferKeepDropsFromMerging) {
  Scene scene = covered(two_spheres(0.01));
  scene.interfaces[1].surfactant->diffusivity = 0.2;
  const TopologyReport report =
      apply_topology(scene, {.coalescence = true, .coalescence_gap = 0.02}, {});
  ASSERT_TRUE(report.refusal);
  EXPECT_EQ(report.refusal->kind, FaultKind::unlike_liquids);
  EXPECT_NE(report.refusal->text.find("different surfactants"), std::string::npos);
}

// Far from the neck nothing is to be seen of a cut but a remeshing of the children.
TEST(CarriedFields, AreChangedByACutOnlyNearTheNeck) {
  Scene scene = dumbbell();
  for (Interface& drop : scene.interfaces) {
    drop.fields = waves(drop.mesh);
    // 1 on the neck and −1 far from it: what the cut takes is above all of what is far.
    for (const VertexId v : drop.mesh.x.ids())
      drop.fields.on_vertices[1].values[v] = std::abs(drop.mesh.x[v].x()) < 0.6 ? 0.5 : -1.0;
  }
  ASSERT_EQ(apply_topology(scene, {.breakup_radius = 0.06}, {}).events.size(), 1U);
  for (const Interface& drop : scene.interfaces)
    for (const VertexId v : drop.mesh.x.ids())
      if (std::abs(drop.mesh.x[v].x()) > 1.5) {
        EXPECT_NEAR(drop.fields.on_vertices[1].values[v], -1.0, 0.02);
      }
}

/// A sphere with a slit pressed into it that no remeshing can round.
SurfaceMesh slit_sphere() {
  SurfaceMesh mesh = sphere(1200, 1.0);
  for (Vec3& x : mesh.x) {
    const double across = std::abs(x.y()) / 0.05, along = std::abs(x.x()) / 0.4;
    if (x.z() > 0.0 && across < 1.0 && along < 1.0) x *= 1.0 - 0.6 * (1.0 - across);
  }
  return mesh;
}

TEST(CarriedFields, GoThroughMendedCreases) {
  SurfaceMesh mesh = slit_sphere(), bare = mesh;
  SurfaceFields fields = waves(mesh);
  Amounts before, after;
  add_amounts(mesh, fields, before);
  const RemeshOptions options = sound_remeshing(10.0, 0.05);
  ASSERT_TRUE(remesh_or_mend(bare, options).is_mended);
  const MendReport report = remesh_or_mend(mesh, options, fields);
  ASSERT_TRUE(report.remesh.ok() && report.is_mended) << report.remesh.text();
  EXPECT_EQ(mesh, bare);
  add_amounts(mesh, fields, after);
  expect_same(after, before);
  record(report.remesh.field_excess);
  expect_in_range(fields, report.remesh.field_excess);
}

}  // namespace
}  // namespace meniscus
