#include "meniscus/volume/smooth_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/volume/quality.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

double mean_ratio(const TetMesh& mesh, CellId c) {
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      squares += (mesh.x[mesh.cells[c][i]] - mesh.x[mesh.cells[c][j]]).squaredNorm();
  return 12.0 * std::cbrt(std::pow(3.0 * signed_volume(mesh, c), 2)) / squares;
}

/// The least mean ratio of the cells on faces of interfaces that have a vertex off the surfaces.
double worst_beside_interfaces(const TetMesh& mesh) {
  const std::int32_t first_free = first_free_vertex(mesh).value;
  double worst = std::numeric_limits<double>::infinity();
  for (const EmbeddedSurface& interface : mesh.interfaces)
    for (const auto& sides : interface.sides)
      for (const CellId c : {sides.inside, sides.outside})
        if (std::ranges::max(mesh.cells[c]).value >= first_free)
          worst = std::min(worst, mean_ratio(mesh, c));
  return worst;
}

TEST(SmoothCells, RaisesFlatCellsOnInterfacesAndMovesNoSurface) {
  std::mt19937 random(5);
  double angles = 0.0, angles_before = 0.0;
  for (int n = 0; n < 10; ++n) {
    Scene scene = test::scene_within(box(90, Vec3(8.0, 8.0, 8.0)).mesh);
    test::add_drop(scene, test::random_ellipsoid(random, 60 + 30 * n, Vec3::Zero()));
    TetMesh mesh;
    ASSERT_TRUE(tetrahedralize(scene, {.grading = Grading::gaussian}, mesh).ok());
    const TetMesh before = mesh;
    smooth_cells(mesh);
    EXPECT_EQ(text_of(find_defect(mesh, scene)), "");
    EXPECT_EQ(mesh.cells.span().size(), before.cells.span().size());
    for (std::int32_t v = 0; v < first_free_vertex(before).value; ++v)
      EXPECT_EQ(mesh.x[TetVertexId{v}], before.x[TetVertexId{v}]);
    EXPECT_GT(worst_beside_interfaces(mesh), worst_beside_interfaces(before));
    EXPECT_GT(worst_beside_interfaces(mesh), 0.3);
    EXPECT_GT(smallest_dihedral_deg(mesh), 0.8 * smallest_dihedral_deg(before));
    angles += smallest_dihedral_deg(mesh);
    angles_before += smallest_dihedral_deg(before);
  }
  EXPECT_GT(angles, angles_before);
}

TEST(SmoothCells, IsPartOfMeshesForCurvedInterfaces) {
  const Scene scene = test::drop_in_sphere(110, 6.0, 90);
  VolumeMeshOptions options{.grading = Grading::gaussian};
  TetMesh plain, smoothed;
  ASSERT_TRUE(tetrahedralize(scene, options, plain).ok());
  options.curves_interfaces = true;
  ASSERT_TRUE(tetrahedralize(scene, options, smoothed).ok());
  smooth_cells(plain);
  EXPECT_TRUE(std::ranges::equal(plain.x.span(), smoothed.x.span()));
}

TEST(SmoothCells, StopsWhereAllCellsAreGood) {
  // Eight corners of a cube and a vertex inside, joined to the twelve triangles around.
  TetMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.x.add(Vec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0));
  const TetVertexId inner = mesh.x.add(Vec3(0.1, -0.2, -0.95));
  const int squares[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : squares)
    for (const auto& [a, b, c] : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}})
      mesh.cells.add({inner, TetVertexId{a}, TetVertexId{c}, TetVertexId{b}});
  for (const CellId c : mesh.cells.ids()) {
    if (signed_volume(mesh, c) < 0.0) std::swap(mesh.cells[c][1], mesh.cells[c][2]);
    mesh.region.add(RegionId{0});
  }
  mesh.boundary.first_vertex = TetVertexId{0};
  mesh.boundary.num_vertices = 8;
  double worst = 1.0;
  smooth_cells(mesh);
  for (const CellId c : mesh.cells.ids()) worst = std::min(worst, mean_ratio(mesh, c));
  // It stops once all cells are better than ½.
  EXPECT_GE(worst, 0.5);
  const Vec3 there = mesh.x[inner];
  smooth_cells(mesh);
  EXPECT_EQ(mesh.x[inner], there);
}

}  // namespace
}  // namespace meniscus
