#include "meniscus/app/scalar_arrays.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

/// Two tetrahedra on either side of the face 0 1 2, the only one of the interface, in a numbering
/// that puts another vertex before it.
struct TwoCells {
  Scene scene;
  TetMesh mesh;
  BulkScalars scalars;

  TwoCells() {
    for (const Vec3& x :
         {Vec3(0, 0, -1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      mesh.x.add(x);
    const auto cell = [&](int a, int b, int c, int d, int region) {
      mesh.cells.add({TetVertexId{a}, TetVertexId{b}, TetVertexId{c}, TetVertexId{d}});
      mesh.region.add(RegionId{region});
    };
    cell(1, 3, 2, 0, 1);
    cell(1, 2, 3, 4, 0);
    EmbeddedSurface surface;
    surface.first_vertex = TetVertexId{1};
    surface.num_vertices = 3;
    mesh.interfaces = {surface};
    Interface interface;
    for (int v = 1; v <= 3; ++v) interface.mesh.x.add(mesh.x[TetVertexId{v}]);
    interface.inside = RegionId{1};
    interface.outside = RegionId{0};
    scene.interfaces = {interface};
    scene.scalars = {{.name = "heat"}, {.name = "dye", .is_species = true}};
    scene.liquids.add(liquid(5.0, 2.0));
    scene.liquids.add(liquid(7.0, 3.0));
    // A value at the middle of an edge follows those at the vertices.
    scalars = {{.values = {10, 11, 12, 13, 14, 99}}, {.values = {20, 21, 22, 23, 24, 99}}};
  }

  static Liquid liquid(double of_heat, double of_dye) {
    Liquid liquid;
    liquid.scalars = {{.capacity = of_heat}, {.capacity = of_dye}};
    return liquid;
  }
};

TEST(ScalarArrays, HeatIsOnVerticesAndSpeciesOnCorners) {
  const TwoCells two;
  const ScalarArrays arrays = scalars_in_volume(two.scene, two.mesh, two.scalars);
  ASSERT_EQ(arrays.on_vertices.size(), 1U);
  EXPECT_EQ(arrays.on_vertices[0].name, "heat");
  EXPECT_EQ(arrays.on_vertices[0].values, (std::vector<double>{10, 11, 12, 13, 14}));
  ASSERT_EQ(arrays.on_corners.size(), 1U);
  EXPECT_EQ(arrays.on_corners[0].name, "dye");
  EXPECT_EQ(arrays.on_corners[0].values,
            (std::vector<double>{63, 69, 66, 60, 42, 44, 46, 48}));  // γ = 3 in the drop, 2 around
}

TEST(ScalarArrays, InterfacesHaveTheOuterConcentration) {
  const TwoCells two;
  const auto arrays = scalars_on_interfaces(two.scene, two.mesh, two.scalars);
  ASSERT_EQ(arrays.size(), 2U);
  EXPECT_EQ(arrays[0].name, "heat");
  EXPECT_EQ(arrays[0].values, (std::vector<double>{11, 12, 13}));
  EXPECT_EQ(arrays[1].name, "dye");
  EXPECT_EQ(arrays[1].values, (std::vector<double>{42, 44, 46}));
}

TEST(ScalarArrays, WithoutScalarsThereAreNone) {
  TwoCells two;
  two.scene.scalars.clear();
  const ScalarArrays arrays = scalars_in_volume(two.scene, two.mesh, {});
  EXPECT_TRUE(arrays.on_vertices.empty());
  EXPECT_TRUE(arrays.on_corners.empty());
  EXPECT_TRUE(scalars_on_interfaces(two.scene, two.mesh, {}).empty());
}

}  // namespace
}  // namespace meniscus
