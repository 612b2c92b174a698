#include "meniscus/mesh/surface_repair.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

using Corners = std::vector<std::int64_t>;

PolygonSoup soup_of(const std::vector<Vec3>& points, const std::vector<Corners>& faces) {
  PolygonSoup soup{.points = points, .corners = {}, .ends = {}, .tags = {}};
  for (const Corners& face : faces) {
    soup.corners.insert(soup.corners.end(), face.begin(), face.end());
    soup.end_face();
  }
  return soup;
}

PolygonSoup soup_of(const SurfaceMesh& mesh) {
  std::vector<Corners> faces;
  for (const FaceVertices& f : mesh.faces) faces.push_back({f[0].value, f[1].value, f[2].value});
  return soup_of({mesh.x.begin(), mesh.x.end()}, faces);
}

/// The cube [0, 2]³ of six squares, faces outward.
std::vector<Vec3> cube_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(2 * (i & 1), 2 * (i >> 1 & 1), 2 * (i >> 2 & 1));
  return points;
}
std::vector<Corners> cube_faces() {
  return {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
}

void expect_cube(const RepairedSurface& surface) {
  EXPECT_FALSE(find_defect(surface.mesh)) << text_of(find_defect(surface.mesh));
  EXPECT_EQ(surface.mesh.num_faces(), 12);
  EXPECT_EQ(enclosed_volume(surface.mesh), 8.0);
}

TEST(SurfaceRepair, SquaresAreCutIntoTriangles) {
  PolygonSoup soup = soup_of(cube_points(), cube_faces());
  soup.tags = {0, 1, 2, 3, 4, 5};
  const RepairedSurface surface = surface_of(soup, false);
  expect_cube(surface);
  EXPECT_EQ(surface.report.polygons, 6);
  EXPECT_EQ(surface.report.turned, 0);
  EXPECT_EQ(surface.tag, FaceField<int>(std::vector{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
  EXPECT_EQ(text_of(surface.report), "6 faces of more than three corners cut into triangles");
}

TEST(SurfaceRepair, AConcavePolygonIsCutWithinItself) {
  // An L-shaped prism: two hexagons and six squares.
  std::vector<Vec3> points;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] :
         std::array<std::array<double, 2>, 6>{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}})
      points.emplace_back(x, y, z);
  std::vector<Corners> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (int i = 0; i < 6; ++i) faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  const RepairedSurface surface = surface_of(soup_of(points, faces), false);
  EXPECT_FALSE(find_defect(surface.mesh)) << text_of(find_defect(surface.mesh));
  EXPECT_NEAR(enclosed_volume(surface.mesh), 3.0, 1e-15);
  EXPECT_EQ(surface.mesh.num_faces(), 20);
}

TEST(SurfaceRepair, FacesAreTurned) {
  std::vector<Corners> faces = cube_faces();
  for (const std::size_t f : {1, 4}) std::ranges::reverse(faces[f]);
  const RepairedSurface two = surface_of(soup_of(cube_points(), faces), false);
  expect_cube(two);
  EXPECT_EQ(two.report.turned, 4);  // triangles
  faces = cube_faces();
  for (Corners& face : faces) std::ranges::reverse(face);
  const RepairedSurface all = surface_of(soup_of(cube_points(), faces), false);
  expect_cube(all);
  EXPECT_EQ(all.report.turned, 12);
}

TEST(SurfaceRepair, ACavityStaysOneAndTurnsWithWhatItLiesIn) {
  SurfaceMesh cavity = sphere(60, 0.5);
  turn_inside_out(cavity);
  SurfaceMesh hollow = joined_surface(std::vector{sphere(60), cavity});
  EXPECT_EQ(surface_of(soup_of(hollow), false).mesh, hollow);
  SurfaceMesh inverted = hollow;
  turn_inside_out(inverted);
  const RepairedSurface turned = surface_of(soup_of(inverted), false);
  EXPECT_NEAR(enclosed_volume(turned.mesh), enclosed_volume(hollow), 1e-14);
  EXPECT_EQ(turned.report.turned, hollow.num_faces());
}

TEST(SurfaceRepair, SoundSurfacesStayAsTheyAre) {
  const SurfaceMesh mesh = stretched_sphere(200, Vec3(1, 2, 0.5));
  for (const bool mends : {false, true}) {
    const RepairedSurface surface = surface_of(soup_of(mesh), mends);
    EXPECT_EQ(surface.mesh, mesh);
    EXPECT_FALSE(surface.report.is_changed());
    EXPECT_EQ(text_of(surface.report), "");
  }
}

TEST(SurfaceRepair, SquaresWithPointsOfTheirOwnAreJoined) {
  std::vector<Vec3> points;
  std::vector<Corners> faces;
  const std::vector<Vec3> corners = cube_points();
  for (const Corners& face : cube_faces()) {
    Corners& own = faces.emplace_back();
    for (const std::int64_t corner : face) {
      own.push_back(static_cast<std::int64_t>(points.size()));
      points.push_back(corners[static_cast<std::size_t>(corner)]);
    }
  }
  EXPECT_TRUE(find_defect(surface_of(soup_of(points, faces), false).mesh));
  const RepairedSurface surface = surface_of(soup_of(points, faces), true);
  expect_cube(surface);
  EXPECT_EQ(surface.report.merged_points, 16);
}

TEST(SurfaceRepair, SmallHolesAreFilledAndLargeOnesNamed) {
  std::vector<Corners> faces = cube_faces();
  faces.pop_back();
  const RepairedSurface open = surface_of(soup_of(cube_points(), faces), true);
  ASSERT_TRUE(find_defect(open.mesh));
  ASSERT_TRUE(open.report.left);
  const std::string text = text_of(*find_defect(open.mesh), open.report);
  EXPECT_NE(text.find("a hole of 4 edges near (1, 1, 2), 2.83 across, is not filled"),
            std::string::npos)
      << text;
  const SurfaceMesh ball = sphere(2000);
  PolygonSoup soup = soup_of(ball);
  soup.corners.resize(soup.corners.size() - 3);
  soup.ends.pop_back();
  EXPECT_TRUE(find_defect(surface_of(soup, false).mesh));
  const RepairedSurface closed = surface_of(soup, true);
  EXPECT_FALSE(find_defect(closed.mesh)) << text_of(find_defect(closed.mesh));
  EXPECT_EQ(closed.report.filled_holes, 1);
  EXPECT_LT(closed.report.largest_hole, 0.2);
  EXPECT_NEAR(enclosed_volume(closed.mesh), enclosed_volume(ball), 1e-12);
}

TEST(SurfaceRepair, DoubledAndEmptyFacesAreRemoved) {
  std::vector<Vec3> points = cube_points();
  std::vector<Corners> faces = cube_faces();
  faces.push_back(faces.front());
  faces.push_back({0, 1, 1});
  const RepairedSurface surface = surface_of(soup_of(points, faces), true);
  expect_cube(surface);
  EXPECT_EQ(surface.report.removed_faces, 3);
}

TEST(SurfaceRepair, CrossingFacesAreReplaced) {
  SurfaceMesh mesh = sphere(2000);
  // One vertex drawn along the sphere: its faces go below others and come out among them.
  const VertexId v{1000};
  mesh.x[v] = 1.02 * (mesh.x[v] + 0.5 * mesh.x[v].unitOrthogonal()).normalized();
  ASSERT_TRUE(find_self_intersection(mesh));
  const RepairedSurface surface = surface_of(soup_of(mesh), true);
  EXPECT_FALSE(find_defect(surface.mesh)) << text_of(find_defect(surface.mesh));
  EXPECT_GT(surface.report.crossing_faces, 0);
  EXPECT_NEAR(enclosed_volume(surface.mesh), enclosed_volume(sphere(2000)), 0.01);
}

}  // namespace
}  // namespace meniscus
