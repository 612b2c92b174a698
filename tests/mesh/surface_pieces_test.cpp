#include "meniscus/mesh/surface_pieces.hpp"

#include <array>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/solid_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

TEST(SurfacePieces, ComeBackInTheOrderOfTheirFaces) {
  const std::array pieces{sphere(60), sphere(12, 0.5, Vec3(3, 0, 0)),
                          sphere(30, 0.2, Vec3(0, 5, 0))};
  SurfaceMesh whole = joined(pieces);
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

TEST(SolidCheck, AllowsPiecesAndCavities) {
  SurfaceMesh cavity = sphere(60, 0.5);
  turn_inside_out(cavity);
  EXPECT_EQ(find_solid_defect(joined(std::array{sphere(60), cavity})), "");
  EXPECT_EQ(find_solid_defect(joined(std::array{sphere(60), sphere(60, 0.5)})), "");
  const std::string outside =
      find_solid_defect(joined(std::array{cavity, sphere(60, 1.0, Vec3(3, 0, 0))}));
  EXPECT_NE(outside.find("inside out"), std::string::npos) << outside;
  const std::string crossing =
      find_solid_defect(joined(std::array{sphere(60), sphere(60, 1.0, Vec3(0.3, 0.1, 0))}));
  EXPECT_NE(crossing.find("meets itself"), std::string::npos) << crossing;
}

TEST(SolidCheck, NamesThePlace) {
  SurfaceMesh open = sphere(60);
  open.faces.resize(open.num_faces() - 1);
  EXPECT_NE(find_solid_defect(open).find("not closed"), std::string::npos);
  SurfaceMesh flat = sphere(60);
  const FaceVertices& f = flat.faces[FaceId{7}];
  flat.x[f[0]] = flat.x[f[1]];
  EXPECT_NE(find_solid_defect(flat).find("has no area"), std::string::npos);
  SurfaceMesh twice = sphere(60);
  twice.faces[FaceId{7}][0] = twice.faces[FaceId{7}][1];
  EXPECT_NE(find_solid_defect(twice).find("face 7"), std::string::npos);
  EXPECT_EQ(find_solid_defect(SurfaceMesh{}), "surface has no faces");
}

}  // namespace
}  // namespace meniscus
