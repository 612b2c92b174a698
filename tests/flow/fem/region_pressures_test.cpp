#include "meniscus/flow/fem/region_pressures.hpp"

#include <gtest/gtest.h>

#include "tests/flow/fem/straight_space.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {
namespace {

TEST(ConstantPressureShares, AreWhatTheMassMatrixLacks) {
  for (const double lambda : {0.01, 0.5, 5.0}) {
    const Scene scene = stretched_drop(DropShape::prolate, 60, lambda);
    TetMesh mesh;
    ASSERT_TRUE(tetrahedralize(scene, {}, mesh).ok());
    const FlowSpace space = flow_space(mesh, Elements::p1_p1);
    const Field<RegionId, double> shares = constant_pressure_shares(instant(scene, mesh, space));
    ASSERT_EQ(shares.size(), 2);
    EXPECT_EQ(shares[RegionId{0}], 0.0);
    EXPECT_NEAR(shares[RegionId{1}], lambda < 1.0 ? 2.0 / 3.0 * (1.0 / lambda - 1.0) : 0.0, 1e-9);
  }
}

// A core in a drop has the drop around it, not the matrix.
TEST(ConstantPressureShares, LookAcrossTheOwnInterface) {
  Scene scene = stretched_drop(DropShape::sphere, 60, 0.1);
  Interface core = scene.interfaces[0];
  for (Vec3& x : core.mesh.x) x *= 0.5;
  core.inside = RegionId{2};
  core.outside = RegionId{1};
  scene.interfaces.push_back(core);
  Liquid thin = scene.liquids[RegionId{1}];
  thin.viscosity = 0.02;
  scene.liquids.add(thin);
  TetMesh mesh;
  ASSERT_TRUE(tetrahedralize(scene, {}, mesh).ok());
  const FlowSpace space = flow_space(mesh, Elements::p1_p1);
  const Field<RegionId, double> shares = constant_pressure_shares(instant(scene, mesh, space));
  ASSERT_EQ(shares.size(), 3);
  EXPECT_NEAR(shares[RegionId{2}], 2.0 / 3.0 * (0.1 / 0.02 - 1.0), 1e-9);
}

}  // namespace
}  // namespace meniscus::fem
