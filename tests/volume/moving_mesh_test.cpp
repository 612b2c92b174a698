#include "meniscus/volume/moving_mesh.hpp"

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/volume/quality.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

Vec3 shear(const Vec3& x) { return {x.y(), 0.0, 0.0}; }

Field<TetVertexId, Vec3> sheared(const TetMesh& mesh) {
  Field<TetVertexId, Vec3> v;
  for (const Vec3& x : mesh.x) v.add(shear(x));
  return v;
}

std::vector<VertexField<Vec3>> sheared(const Scene& scene) {
  std::vector<VertexField<Vec3>> v;
  for (const Interface& interface : scene.interfaces) {
    v.emplace_back();
    for (const Vec3& x : interface.mesh.x) v.back().add(shear(x));
  }
  return v;
}

void move(Scene& scene, double dt) {
  for (Interface& interface : scene.interfaces)
    for (Vec3& x : interface.mesh.x) x += dt * shear(x);
}

MovingMesh mesh_of(const Scene& scene, VolumeMotion motion = VolumeMotion::spines) {
  MovingMesh mesh({.tetrahedra = {}, .motion = motion});
  EXPECT_TRUE(mesh.follow(scene).ok());
  return mesh;
}

class MovingMeshTest : public testing::TestWithParam<VolumeMotion> {};
INSTANTIATE_TEST_SUITE_P(AllMotions, MovingMeshTest,
                         testing::Values(VolumeMotion::spines, VolumeMotion::lagrangian,
                                         VolumeMotion::harmonic));

TEST_P(MovingMeshTest, MovesWithItsInterfacesAndKnowsItsVelocity) {
  const Scene start = test::drop_in_sphere(200, 3.0, 100);
  MovingMesh mesh = mesh_of(start, GetParam());
  const TetMesh before = mesh.tetrahedra();
  mesh.begin_step(start);
  ASSERT_TRUE(mesh.move(start, sheared(start), sheared(before), 0.05).ok());
  Scene moved = start;
  move(moved, 0.05);
  const TetMesh& after = mesh.tetrahedra();
  EXPECT_EQ(after.cells, before.cells);
  for (const VertexId v : moved.interfaces[0].mesh.x.ids())
    EXPECT_EQ(after.x[after.interfaces[0].vertex(v)], moved.interfaces[0].mesh.x[v]);
  for (const VertexId v : start.boundary.mesh.x.ids())
    EXPECT_EQ(after.x[after.boundary.vertex(v)], before.x[before.boundary.vertex(v)]);
  for (const TetVertexId v : after.x.ids())
    EXPECT_EQ(after.x[v], Vec3(before.x[v] + 0.05 * mesh.velocity()[v]));
}

TEST_P(MovingMeshTest, UndoPutsEveryVertexBackToTheBit) {
  const Scene start = test::drop_in_sphere(200, 3.0, 100);
  MovingMesh mesh = mesh_of(start, GetParam());
  const TetMesh before = mesh.tetrahedra();
  mesh.begin_step(start);
  ASSERT_TRUE(mesh.move(start, sheared(start), sheared(before), 0.05).ok());
  ASSERT_NE(mesh.tetrahedra().x, before.x);
  mesh.undo();
  EXPECT_EQ(mesh.tetrahedra().x, before.x);
}

TEST(MovingMesh, UndoForgetsAMeshMadeAnew) {
  const Scene start = test::drop_in_sphere(200, 3.0, 100);
  MovingMesh mesh = mesh_of(start);
  const auto saved = [&] {
    Archive archive;
    mesh.save(archive);
    return archive.reals;
  };
  const auto before = saved();
  mesh.begin_step(start);
  Scene moved = start;
  move(moved, 0.05);
  ASSERT_TRUE(mesh.follow(moved).ok());
  ASSERT_NE(saved().at("mesh/made-angle"), before.at("mesh/made-angle"));
  mesh.undo();
  EXPECT_EQ(saved(), before);
}

// The half step and the whole one start from the same place.
TEST(MovingMesh, EveryMoveOfAStepStartsWhereTheStepDid) {
  const Scene start = test::drop_in_sphere(200, 3.0, 100);
  MovingMesh once = mesh_of(start), twice = once;
  const Field<TetVertexId, Vec3> liquid = sheared(once.tetrahedra());
  once.begin_step(start);
  twice.begin_step(start);
  ASSERT_TRUE(twice.move(start, sheared(start), liquid, 0.025).ok());
  ASSERT_TRUE(twice.move(start, sheared(start), liquid, 0.05).ok());
  ASSERT_TRUE(once.move(start, sheared(start), liquid, 0.05).ok());
  EXPECT_EQ(once.tetrahedra().x, twice.tetrahedra().x);
}

TEST(MovingMesh, IsFitUntilItsAnglesAreSmall) {
  const Scene start = test::drop_in_sphere(110, 3.0, 100);
  MovingMesh mesh = mesh_of(start, VolumeMotion::harmonic);
  const double angle = quality(mesh.tetrahedra()).min_dihedral_deg;
  EXPECT_NEAR(smallest_dihedral_deg(mesh.tetrahedra()), angle, 1e-12);
  EXPECT_TRUE(mesh.is_fit());
  bool was_unfit = false;
  for (const double dt : {0.01, 0.3, 0.6, 0.9, 1.2, 1.5}) {
    mesh.begin_step(start);
    const Report moved = mesh.move(start, sheared(start), sheared(mesh.tetrahedra()), dt);
    if (!moved.ok()) break;
    EXPECT_EQ(mesh.is_fit(), quality(mesh.tetrahedra()).min_dihedral_deg >= 0.7 * angle) << dt;
    was_unfit |= !mesh.is_fit();
    EXPECT_EQ(mesh.smallest_angle_deg(), smallest_dihedral_deg(mesh.tetrahedra()));
    Archive archive;
    mesh.save(archive);
    Scene there = start;
    move(there, dt);
    MovingMesh loaded({.tetrahedra = {}, .motion = VolumeMotion::harmonic});
    loaded.load(archive, there);
    EXPECT_EQ(loaded.is_fit(), mesh.is_fit()) << dt;
    mesh.undo();
    EXPECT_EQ(mesh.smallest_angle_deg(), smallest_dihedral_deg(mesh.tetrahedra()));
    mesh.place_interfaces(there);
    EXPECT_EQ(mesh.smallest_angle_deg(), smallest_dihedral_deg(mesh.tetrahedra()));
    mesh.place_interfaces(start);
    EXPECT_EQ(mesh.smallest_angle_deg(), smallest_dihedral_deg(mesh.tetrahedra()));
  }
  EXPECT_TRUE(was_unfit);
}

TEST(MovingMesh, InvertedCellIsReportedAndTheMeshIsAsItWas) {
  const Scene start = test::drop_in_sphere(110, 3.0, 100);
  MovingMesh mesh = mesh_of(start);
  const TetMesh before = mesh.tetrahedra();
  mesh.begin_step(start);
  std::vector<VertexField<Vec3>> far = sheared(start);
  for (Vec3& v : far[0]) v = Vec3(100.0, 0.0, 0.0);
  const Report report = mesh.move(start, far, sheared(before), 1.0);
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.text().find("inverts a cell"), std::string::npos) << report.text();
  EXPECT_EQ(mesh.tetrahedra().x, before.x);
}

TEST(MovingMesh, FollowingSaysWhereTheOuterBoundaryWent) {
  Scene scene = test::drop_in_sphere(110, 3.0, 100);
  MovingMesh mesh = mesh_of(scene);
  const TetMesh before = mesh.tetrahedra();
  scene.interfaces[0].mesh = sphere(200, 1.1);
  const MeshChange change = mesh.follow(scene);
  ASSERT_TRUE(change.ok()) << change.text();
  const TetMesh& after = mesh.tetrahedra();
  ASSERT_EQ(change.old_to_new.size(), before.num_vertices());
  int counterparts = 0;
  for (const TetVertexId v : before.x.ids()) {
    const TetVertexId now = change.old_to_new[v];
    if (!now.is_valid()) continue;
    EXPECT_EQ(after.x[now], before.x[v]);
    ++counterparts;
  }
  EXPECT_EQ(counterparts, scene.boundary.mesh.num_vertices());
}

TEST(MovingMesh, AFailedMesherLeavesTheMeshAsItWas) {
  const Scene scene = test::drop_in_sphere(110, 3.0, 100);
  bool fails = false;
  MovingMesh mesh(VolumeMotion::spines, [&](const Scene& of, const TetMesh& before, TetMesh& made) {
    if (fails) return VolumeMeshReport{{Fault{FaultKind::mesher, "told to fail"}}};
    return tetrahedralize(of, {}, before, made);
  });
  ASSERT_TRUE(mesh.follow(scene).ok());
  const TetMesh before = mesh.tetrahedra();
  fails = true;
  const MeshChange change = mesh.follow(scene);
  EXPECT_FALSE(change.ok());
  EXPECT_EQ(change.text(), "told to fail");
  EXPECT_EQ(mesh.tetrahedra().x, before.x);
}

/// Moves a vertex between the surfaces so near to another one that a cell there is thin.
void spoil(TetMesh& mesh) {
  const TetVertexId first{mesh.boundary.first_vertex.value + mesh.boundary.num_vertices};
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c]) {
      if (v < first) continue;
      const Vec3 before = mesh.x[v];
      mesh.x[v] += 0.9 * (mesh.x[mesh.cells[c][0]] - before);
      if (quality(mesh).min_volume > 0.0 && smallest_dihedral_deg(mesh) < 5.0) return;
      mesh.x[v] = before;
    }
  FAIL() << "every vertex is needed where it is";
}

TEST(MovingMesh, TakesOverNothingWhereThatMakesPoorCells) {
  const Scene scene = test::drop_in_sphere(110, 3.0, 100);
  int from_none = 0, from_before = 0;
  MovingMesh mesh(VolumeMotion::spines, [&](const Scene& of, const TetMesh& before, TetMesh& made) {
    ++(before.num_vertices() == 0 ? from_none : from_before);
    const VolumeMeshReport report = tetrahedralize(of, {}, made);
    if (before.num_vertices() > 0) spoil(made);
    return report;
  });
  ASSERT_TRUE(mesh.follow(scene).ok());
  const double angle = smallest_dihedral_deg(mesh.tetrahedra());
  EXPECT_GT(angle, 7.5);
  ASSERT_TRUE(mesh.follow(scene).ok());
  EXPECT_EQ(from_none, 2);
  EXPECT_EQ(from_before, 1);
  EXPECT_EQ(smallest_dihedral_deg(mesh.tetrahedra()), angle);
}

TEST(MovingMesh, ComesBackFromAnArchiveAndRefusesADamagedOne) {
  const Scene scene = test::drop_in_sphere(110, 3.0, 100);
  const MovingMesh mesh = mesh_of(scene);
  Archive archive;
  mesh.save(archive);
  MovingMesh again{MovingMeshOptions{}};
  again.load(archive, scene);
  EXPECT_EQ(again.tetrahedra().x, mesh.tetrahedra().x);
  EXPECT_EQ(again.tetrahedra().cells, mesh.tetrahedra().cells);
  const Scene other = test::drop_in_sphere(60, 3.0, 100);
  EXPECT_THROW(again.load(archive, other), InvalidInput);
  archive.reals.erase("mesh/x");
  EXPECT_THROW(again.load(archive, scene), InvalidInput);
}

}  // namespace
}  // namespace meniscus
