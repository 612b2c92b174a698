#include "meniscus/mesh/surface_pieces.hpp"

#include <array>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

TEST(SurfacePieces, ComeBackInTheOrderOfTheirFaces) {
  const std::array pieces{sphere(60), sphere(12, 0.5, Vec3(3, 0, 0)),
                          sphere(30, 0.2, Vec3(0, 5, 0))};
  SurfaceMesh whole = joined_surface(pieces);
  EXPECT_EQ(whole.num_vertices(), 102);
  whole.x.add(Vec3(9, 9, 9));  // no face has it
  const std::vector<SurfaceMesh> found = connected_pieces(whole);
  ASSERT_EQ(found.size(), pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) EXPECT_EQ(found[i], pieces[i]);
  EXPECT_TRUE(connected_pieces(SurfaceMesh{}).empty());
}

TEST(SurfacePieces, TurningOverNegatesTheVolume) {
  SurfaceMesh mesh = sphere(60);
  const double volume = enclosed_volume(mesh);
  turn_inside_out(mesh);
  EXPECT_NEAR(enclosed_volume(mesh), -volume, 1e-14);
}

}  // namespace
}  // namespace meniscus
