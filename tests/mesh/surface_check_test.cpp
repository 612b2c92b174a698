#include "meniscus/mesh/surface_check.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/cgal_surface.hpp"
#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

void expect_defect(const SurfaceMesh& mesh, const std::string& word) {
  const std::string defect = text_of(find_defect(mesh));
  EXPECT_NE(defect.find(word), std::string::npos) << "found: '" << defect << "'";
}

SurfaceMesh translated(SurfaceMesh mesh, const Vec3& by) {
  for (Vec3& x : mesh.x) x += by;
  return mesh;
}

TEST(FindDefect, PassesSoundSurfaces) {
  EXPECT_EQ(text_of(find_defect(sphere(12))), "");
  EXPECT_EQ(text_of(find_defect(stretched_sphere(500, Vec3(4.0, 0.3, 0.3)))), "");
  EXPECT_EQ(text_of(find_defect(box(150, Vec3(1.0, 2.0, 3.0)).mesh)), "");
  EXPECT_EQ(text_of(find_defect(cylinder(300, 1.0, 3.0).mesh)), "");
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.85, 1.15);
    SurfaceMesh bumpy = sphere(200, 1.0, Vec3(3.0, 1.0, -2.0));
    for (Vec3& x : bumpy.x)  // radial, so that it stays star-shaped
      x = Vec3(3.0, 1.0, -2.0) + uniform(random) * (x - Vec3(3.0, 1.0, -2.0));
    EXPECT_EQ(text_of(find_defect(bumpy)), "") << "seed " << seed;
  }
}

TEST(FindDefect, NamesWhatIsWrong) {
  expect_defect(SurfaceMesh{}, "no faces");
  SurfaceMesh open = sphere(42);
  open.faces.resize(open.num_faces() - 1);
  expect_defect(open, "not closed");
  SurfaceMesh doubled = sphere(42);
  doubled.faces.add(doubled.faces[FaceId{0}]);
  expect_defect(doubled, "not manifold");
  SurfaceMesh inside_out = sphere(42);
  for (FaceVertices& f : inside_out.faces) std::swap(f[0], f[1]);
  expect_defect(inside_out, "inside out");
  SurfaceMesh not_finite = sphere(42);
  not_finite.x[VertexId{7}].y() = std::numeric_limits<double>::quiet_NaN();
  expect_defect(not_finite, "vertex 7 is not finite");
  EXPECT_NE(text_of(find_self_intersection(not_finite)), "");
  EXPECT_NE(text_of(find_intersection(not_finite, sphere(42))), "");
  SurfaceMesh out_of_range = sphere(42);
  out_of_range.faces[FaceId{3}][1] = VertexId{42};
  expect_defect(out_of_range, "missing vertex");
  SurfaceMesh lonely = sphere(42);
  lonely.x.add(Vec3(5, 5, 5));
  expect_defect(lonely, "vertex 42 at (5, 5, 5) belongs to no face");
}

/// Both surfaces in one mesh, the vertices of the second after those of the first.
SurfaceMesh together(SurfaceMesh a, const SurfaceMesh& b) {
  const std::int32_t offset = a.num_vertices();
  for (const Vec3& x : b.x) a.x.add(x);
  for (const FaceVertices& f : b.faces)
    a.faces.add({VertexId{f[0].value + offset}, VertexId{f[1].value + offset},
                 VertexId{f[2].value + offset}});
  return a;
}

TEST(FindDefect, NamesASecondPiece) {
  const SurfaceMesh one = sphere(42);
  const SurfaceMesh two = together(one, translated(sphere(42), Vec3(5, 0, 0)));
  expect_defect(two, "more than one piece: vertex 42 at (");
  SurfaceMesh cavity = sphere(42, 0.4);
  for (FaceVertices& f : cavity.faces) std::swap(f[0], f[1]);
  expect_defect(together(one, cavity), "more than one piece");
}

TEST(FindDefect, TellsTheKindAndThePosition) {
  SurfaceMesh open = sphere(42, 1.0, Vec3(3, 0, 0));
  open.faces.resize(open.num_faces() - 1);
  const auto fault = find_defect(open);
  ASSERT_TRUE(fault && fault->position);
  EXPECT_EQ(fault->kind, FaultKind::connectivity);
  EXPECT_NEAR((*fault->position - Vec3(3, 0, 0)).norm(), 1.0, 0.2);  // an edge near the sphere
  EXPECT_NE(fault->text.find(text_of(*fault->position)), std::string::npos) << fault->text;
  const auto built = SurfaceTopology::try_build(open);
  ASSERT_TRUE(std::holds_alternative<Fault>(built));
  EXPECT_EQ(std::get<Fault>(built).text, fault->text);
  EXPECT_THROW(SurfaceTopology{open}, InvalidInput);
}

TEST(FindDefect, NotFiniteComesBeforeNotClosed) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SurfaceMesh open = sphere(42);
    open.faces.resize(open.num_faces() - 1);
    open.x[VertexId{12}].z() = value;
    EXPECT_EQ(text_of(find_defect(open)), "vertex 12 is not finite");
  }
}

TEST(FindDefect, NamesFlatFacesAndPinchedVertices) {
  SurfaceMesh flat = box(8, Vec3::Constant(1.0)).mesh;
  // Split one edge by a vertex in its middle, but in one of its two faces only by a flat one.
  const FaceVertices f = flat.faces[FaceId{0}];
  const VertexId middle = flat.x.add(0.5 * (flat.x[f[0]] + flat.x[f[1]]));
  flat.faces[FaceId{0}] = {f[0], middle, f[2]};
  flat.faces.add({middle, f[1], f[2]});
  flat.faces.add({f[0], f[1], middle});
  expect_defect(flat, "has no area");

  // Two tetrahedra that share one vertex.
  SurfaceMesh pinched;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0),
                        Vec3(0, -1, 0), Vec3(0, 0, -1)})
    pinched.x.add(x);
  const auto add = [&](int a, int b, int c) {
    pinched.faces.add({VertexId{a}, VertexId{b}, VertexId{c}});
  };
  add(0, 2, 1), add(0, 1, 3), add(0, 3, 2), add(1, 2, 3);
  add(0, 4, 5), add(0, 6, 4), add(0, 5, 6), add(4, 6, 5);
  expect_defect(pinched, "more than one fan");
}

TEST(SelfIntersection, IsFoundWithItsPlace) {
  // A vertex pushed through the far side.
  SurfaceMesh pierced = sphere(200);
  const Vec3 out = pierced.x[VertexId{30}];
  pierced.x[VertexId{30}] = -1.3 * out;
  EXPECT_NE(text_of(find_self_intersection(pierced)).find("meets itself"), std::string::npos);
  // Two faces folded on one another across an edge: a valence-3 vertex moved over its edge, in the
  // plane of a face of the box.
  SurfaceMesh folded = box(8, Vec3::Constant(1.0)).mesh;
  const FaceVertices f = folded.faces[FaceId{0}];
  const Vec3 a = folded.x[f[0]], b = folded.x[f[1]], c = folded.x[f[2]];
  const VertexId middle = folded.x.add((a + b + c) / 3.0);
  folded.faces[FaceId{0}] = {f[0], f[1], middle};
  folded.faces.add({f[1], f[2], middle});
  folded.faces.add({f[2], f[0], middle});
  EXPECT_EQ(text_of(find_self_intersection(folded)), "");
  folded.x[middle] += 0.9 * (0.5 * (a + b) - folded.x[middle]);
  EXPECT_EQ(text_of(find_self_intersection(folded)), "");
  folded.x[middle] = 0.5 * (a + b) + 0.2 * (0.5 * (a + b) - c);
  EXPECT_NE(text_of(find_self_intersection(folded)), "");
}

// From surfaces as good as even to crumpled ones, every second of which meets itself, most of them
// in faces that share a vertex or an edge.
TEST(SelfIntersection, IsFoundWhereCgalFindsIt) {
  int num_meeting = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937 random(seed);
    const double size = 0.002 * (seed % 150);
    std::uniform_real_distribution<double> noise(-size, size);
    SurfaceMesh mesh = stretched_sphere(120, Vec3(1.5, 1.0, 0.6));
    for (Vec3& x : mesh.x) x += Vec3(noise(random), noise(random), noise(random));
    const bool meets = CGAL::Polygon_mesh_processing::does_self_intersect(to_cgal(mesh));
    EXPECT_EQ(find_self_intersection(mesh).has_value(), meets) << "seed " << seed;
    num_meeting += static_cast<int>(meets);
  }
  EXPECT_GT(num_meeting, 60);
  EXPECT_LT(num_meeting, 240);
}

TEST(SelfIntersection, SeesSheetsThatJustTouch) {
  // A dimple deepened until its bottom meets the far side, at (0, 0, −1) exactly: faces that share
  // no vertex touch in one point.
  SurfaceMesh mesh = box(150, Vec3::Constant(1.0)).mesh;
  VertexId top;
  for (const VertexId v : mesh.x.ids())
    if (mesh.x[v].z() == 1.0 && (!top.is_valid() || mesh.x[v].head<2>().squaredNorm() <
                                                        mesh.x[top].head<2>().squaredNorm()))
      top = v;
  mesh.x[top].z() = -std::nextafter(1.0, 0.0);
  EXPECT_EQ(text_of(find_self_intersection(mesh)), "");
  mesh.x[top].z() = -1.0;
  const std::string found = text_of(find_self_intersection(mesh));
  EXPECT_NE(found.find("-1)"), std::string::npos) << found;
}

TEST(Intersection, IsFoundBetweenSurfaces) {
  const SurfaceMesh a = sphere(200), b = sphere(150, 0.7);
  EXPECT_EQ(text_of(find_intersection(a, translated(b, Vec3(1.8, 0, 0)))), "");
  EXPECT_EQ(text_of(find_intersection(a, translated(b, Vec3(0.1, 0, 0)))), "");  // nested
  const std::string found = text_of(find_intersection(a, translated(b, Vec3(0, 1.5, 0))));
  EXPECT_NE(found.find("near ("), std::string::npos) << found;
  double x = 0, y = 0, z = 0;
  ASSERT_EQ(std::sscanf(found.c_str(), "surfaces meet near (%lf, %lf, %lf)", &x, &y, &z), 3);
  // Both surfaces pass through the circle y = 1.76/3, x² + z² = 1 − y², to the size of a face.
  EXPECT_NEAR(y, (1.0 + 2.25 - 0.49) / 3.0, 0.3);
  EXPECT_NEAR(Vec3(x, y, z).norm(), 1.0, 0.3);
}

TEST(Encloses, AgreesWithTheShape) {
  const SurfaceMesh ellipsoid = stretched_sphere(1000, Vec3(2.0, 1.0, 0.5), Vec3(1, 1, 1));
  const SurfaceMesh cube = box(150, Vec3::Constant(1.0)).mesh;
  const SurfaceTree tree(ellipsoid);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    const double level = p.cwiseQuotient(Vec3(2.0, 1.0, 0.5)).norm();
    // The faces lie within 2 % of the ellipsoid.
    if (level < 0.98 || level > 1.0) {
      EXPECT_EQ(encloses(tree, p + Vec3(1, 1, 1)), level < 0.98);
    }
    EXPECT_EQ(encloses(cube, p), p.cwiseAbs().maxCoeff() < 1.0);
  }
}

TEST(Encloses, IsExactAtDegeneratePlaces) {
  const SurfaceMesh cube = box(98, Vec3::Constant(1.0)).mesh;  // vertices on a regular grid
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5), Vec3(0, 0, 0.5)}) {
    EXPECT_TRUE(encloses(cube, p));
    EXPECT_FALSE(encloses(cube, p + Vec3(2.0, 0, 0)));
  }
  EXPECT_FALSE(encloses(cube, Vec3(1.0, 0.2, 0.3)));                       // on a face
  EXPECT_FALSE(encloses(cube, Vec3(1.0, 1.0, 1.0)));                       // on a vertex
  EXPECT_TRUE(encloses(cube, Vec3(std::nextafter(1.0, 0.0), 0.2, 0.3)));   // just inside
  EXPECT_FALSE(encloses(cube, Vec3(std::nextafter(1.0, 2.0), 0.2, 0.3)));  // just outside
}

TEST(SmallestGap, OfBoxesAndSpheres) {
  const SurfaceMesh cube = box(98, Vec3::Constant(1.0)).mesh;
  EXPECT_DOUBLE_EQ(smallest_gap(cube, translated(cube, Vec3(2.25, 0.3, 0.0))), 0.25);
  EXPECT_DOUBLE_EQ(smallest_gap(box(98, Vec3::Constant(4.0)).mesh, cube), 3.0);
  const SurfaceMesh a = sphere(800), b = sphere(800, 0.5, Vec3(1.7, 0, 0));
  // Faces lie up to h²/(2 √3 …) ~ 0.5 % of the radius below the sphere.
  EXPECT_NEAR(smallest_gap(a, b), 0.2, 0.01);
  EXPECT_EQ(smallest_gap(a, b), smallest_gap(b, a));
}

}  // namespace
}  // namespace meniscus
