#include "meniscus/surface/edit_mesh.hpp"

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_pieces.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

/// The Euler characteristic of an edited surface, which must be a closed manifold.
int checked_euler_characteristic(const EditMesh& mesh) {
  SurfaceMesh surface;
  const EditMesh::CompactMesh compact = mesh.compact_mesh();
  surface.faces = compact.faces;
  for (std::size_t i = 0; i < compact.vertices.size(); ++i) surface.x.add(Vec3::Zero());
  EXPECT_EQ(text_of(find_broken_connectivity(surface)), "");
  EXPECT_EQ(surface.num_vertices(), mesh.num_vertices());
  return euler_characteristic(surface);
}

TEST(EditMesh, SplitFlipAndCollapseDoAsTheySay) {
  const SurfaceMesh surface = sphere(50);
  EditMesh mesh(surface, SurfaceTopology(surface));
  const HalfedgeId h{30};
  const VertexId a = mesh.from(h), b = mesh.to(h), c = mesh.opposite(h),
                 d = mesh.opposite(mesh.twin(h));
  const VertexId m = mesh.split(h);
  EXPECT_EQ(mesh.num_vertices(), 51);
  EXPECT_EQ(mesh.valence(m), 4);
  EXPECT_FALSE(mesh.are_joined(a, b));
  for (const VertexId v : {a, b, c, d}) EXPECT_TRUE(mesh.are_joined(m, v));
  EXPECT_EQ(checked_euler_characteristic(mesh), 2);

  HalfedgeId am = mesh.out(a);
  while (mesh.to(am) != m) am = EditMesh::next(mesh.twin(am));
  ASSERT_TRUE(mesh.can_collapse(am));
  mesh.collapse(mesh.twin(am));
  EXPECT_FALSE(mesh.is_alive(m));
  EXPECT_TRUE(mesh.are_joined(a, b));
  EXPECT_EQ(checked_euler_characteristic(mesh), 2);

  const HalfedgeId g{60};
  const VertexId p = mesh.opposite(g), q = mesh.opposite(mesh.twin(g));
  const VertexId r = mesh.from(g), s = mesh.to(g);
  mesh.flip(g);
  EXPECT_TRUE(mesh.are_joined(p, q));
  EXPECT_FALSE(mesh.are_joined(r, s));
  EXPECT_EQ(checked_euler_characteristic(mesh), 2);
}

TEST(EditMesh, RandomEditsKeepAClosedManifold) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SurfaceMesh surface = seed % 2 == 0 ? sphere(60) : test::torus(16, 8, 1.0, 0.4);
    EditMesh mesh(surface, SurfaceTopology(surface));
    std::mt19937 random(seed);
    for (int edit = 0; edit < 400; ++edit) {
      const HalfedgeId h{static_cast<std::int32_t>(
          std::uniform_int_distribution<int>(0, mesh.num_halfedge_slots() - 1)(random))};
      if (!mesh.is_alive(h)) continue;
      const VertexId c = mesh.opposite(h), d = mesh.opposite(mesh.twin(h));
      switch (random() % 3) {
        case 0:
          mesh.split(h);
          break;
        case 1:
          if (mesh.valence(mesh.from(h)) > 3 && mesh.valence(mesh.to(h)) > 3 &&
              !mesh.are_joined(c, d))
            mesh.flip(h);
          break;
        default:
          if (mesh.num_vertices() > 20 && mesh.can_collapse(h)) mesh.collapse(h);
      }
    }
    EXPECT_EQ(checked_euler_characteristic(mesh), seed % 2 == 0 ? 2 : 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace meniscus
