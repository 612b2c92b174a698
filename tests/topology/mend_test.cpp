#include "meniscus/topology/mend.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

RemeshOptions coarse() { return {.C0 = 10.0, .edge_floor = 0.05}; }

/// A sphere with a slit pressed into it along a great circle's arc: its sides meet at the bottom
/// and turn by 180° there.
SurfaceMesh slit_sphere(double depth) {
  SurfaceMesh mesh = sphere(1200, 1.0);
  for (Vec3& x : mesh.x) {
    const double across = std::abs(x.y()) / 0.05, along = std::abs(x.x()) / 0.4;
    if (x.z() > 0.0 && across < 1.0 && along < 1.0) x *= 1.0 - depth * (1.0 - across);
  }
  return mesh;
}

TEST(Mend, LeavesWhatCanBeRemeshedToTheRemesher) {
  SurfaceMesh mended = sphere(400, 1.0), remeshed = mended;
  const MendReport report = remesh_or_mend(mended, coarse());
  EXPECT_TRUE(report.remesh.ok);
  EXPECT_FALSE(report.is_mended);
  ASSERT_TRUE(remesh(remeshed, coarse()).ok);
  EXPECT_EQ(mended, remeshed);
}

TEST(Mend, LeavesASoundSurfaceOfTheSameVolumeWhereCreasesAreSharp) {
  RemeshOptions options = coarse();
  options.find_fault = find_self_intersection;
  bool was_mended = false;
  for (const double depth : {0.2, 0.3, 0.4, 0.5, 0.6}) {
    SurfaceMesh mesh = slit_sphere(depth);
    const double volume = enclosed_volume(mesh);
    const MendReport report = remesh_or_mend(mesh, options);
    ASSERT_TRUE(report.remesh.ok) << depth << ": " << report.remesh.failure;
    was_mended = was_mended || report.is_mended;
    EXPECT_EQ(find_defect(mesh), "");
    EXPECT_EQ(test::euler_characteristic(mesh), 2);
    EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12 * volume);
  }
  EXPECT_TRUE(was_mended) << "no slit was too sharp for the remesher";
}

}  // namespace
}  // namespace meniscus
