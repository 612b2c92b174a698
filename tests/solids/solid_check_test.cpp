#include "meniscus/solids/solid_check.hpp"

#include <array>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

TEST(SolidCheck, AllowsPiecesAndCavities) {
  SurfaceMesh cavity = sphere(60, 0.5);
  turn_inside_out(cavity);
  EXPECT_EQ(text_of(find_solid_defect(joined_surface(std::array{sphere(60), cavity}))), "");
  EXPECT_EQ(text_of(find_solid_defect(joined_surface(std::array{sphere(60), sphere(60, 0.5)}))),
            "");
  const std::string outside = text_of(
      find_solid_defect(joined_surface(std::array{cavity, sphere(60, 1.0, Vec3(3, 0, 0))})));
  EXPECT_NE(outside.find("inside out"), std::string::npos) << outside;
  const std::string crossing = text_of(find_solid_defect(
      joined_surface(std::array{sphere(60), sphere(60, 1.0, Vec3(0.3, 0.1, 0))})));
  EXPECT_NE(crossing.find("meets itself"), std::string::npos) << crossing;
}

TEST(SolidCheck, NamesThePlace) {
  SurfaceMesh open = sphere(60);
  open.faces.resize(open.num_faces() - 1);
  EXPECT_NE(text_of(find_solid_defect(open)).find("not closed"), std::string::npos);
  SurfaceMesh flat = sphere(60);
  const FaceVertices& f = flat.faces[FaceId{7}];
  flat.x[f[0]] = flat.x[f[1]];
  EXPECT_NE(text_of(find_solid_defect(flat)).find("has no area"), std::string::npos);
  SurfaceMesh twice = sphere(60);
  twice.faces[FaceId{7}][0] = twice.faces[FaceId{7}][1];
  EXPECT_NE(text_of(find_solid_defect(twice)).find("face 7"), std::string::npos);
  EXPECT_EQ(text_of(find_solid_defect(SurfaceMesh{})), "surface has no faces");
}

}  // namespace
}  // namespace meniscus
