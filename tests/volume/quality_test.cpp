#include "meniscus/volume/quality.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TetMesh one_cell(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  TetMesh mesh;
  for (const Vec3& x : {a, b, c, d}) mesh.x.add(x);
  mesh.cells.add({TetVertexId{0}, TetVertexId{1}, TetVertexId{2}, TetVertexId{3}});
  mesh.region.add(RegionId{0});
  return mesh;
}

TEST(Quality, OfTheRegularTetrahedron) {
  const TetMesh mesh = one_cell(Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1));
  const MeshQuality q = quality(mesh);
  const double angle = std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi;  // 70.53°
  EXPECT_NEAR(q.min_dihedral_deg, angle, 1e-12);
  EXPECT_NEAR(q.max_dihedral_deg, angle, 1e-12);
  EXPECT_NEAR(q.min_radius_ratio, 1.0, 1e-14);
  EXPECT_NEAR(q.min_volume, 8.0 / 3.0, 1e-14);
  EXPECT_EQ(q.below_10_deg, 0.0);
}

TEST(Quality, OfTheCornerOfACube) {
  const MeshQuality q =
      quality(one_cell(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()));
  EXPECT_NEAR(q.min_dihedral_deg, std::acos(1.0 / std::sqrt(3.0)) * 180.0 / std::numbers::pi,
              1e-12);
  EXPECT_NEAR(q.max_dihedral_deg, 90.0, 1e-12);
  // r = 1/(3 + √3), R = √3/2.
  EXPECT_NEAR(q.min_radius_ratio, 3.0 / (3.0 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2.0), 1e-14);
}

TEST(Quality, OfASliverAndOfAnInvertedCell) {
  // Four points around a square, by turns a distance t above and below its plane: at the two
  // diagonals the facets are nearly coplanar, at the four sides they nearly coincide.
  const double t = 0.01;
  const TetMesh sliver = one_cell(Vec3(1, 0, t), Vec3(0, 1, -t), Vec3(-1, 0, t), Vec3(0, -1, -t));
  const MeshQuality q = quality(sliver);
  EXPECT_EQ(q.below_10_deg, 1.0);
  EXPECT_LT(q.min_dihedral_deg, 5.0);
  EXPECT_GT(q.max_dihedral_deg, 175.0);
  EXPECT_EQ(min_dihedral_deg(sliver)[CellId{0}], q.min_dihedral_deg);
  TetMesh inverted = sliver;
  std::swap(inverted.cells[CellId{0}][0], inverted.cells[CellId{0}][1]);
  EXPECT_EQ(quality(sliver).min_volume, -quality(inverted).min_volume);
  EXPECT_LT(std::min(quality(sliver).min_radius_ratio, quality(inverted).min_radius_ratio), 0.0);
}

TEST(Quality, DoesNotDependOnOrderOrScale) {
  const Vec3 x[] = {Vec3(0.1, 0.2, 0.0), Vec3(1.3, 0.1, 0.2), Vec3(0.3, 0.9, -0.1),
                    Vec3(0.4, 0.3, 0.8)};
  const MeshQuality q = quality(one_cell(x[0], x[1], x[2], x[3]));
  const MeshQuality r = quality(one_cell(7.0 * x[1], 7.0 * x[2], 7.0 * x[0], 7.0 * x[3]));
  EXPECT_NEAR(q.min_dihedral_deg, r.min_dihedral_deg, 1e-12);
  EXPECT_NEAR(q.max_dihedral_deg, r.max_dihedral_deg, 1e-12);
  EXPECT_NEAR(q.min_radius_ratio, r.min_radius_ratio, 1e-14);
  EXPECT_NEAR(343.0 * q.min_volume, r.min_volume, 1e-12);
}

}  // namespace
}  // namespace meniscus
