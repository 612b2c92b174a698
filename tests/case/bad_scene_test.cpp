// Faults that show only when the scene of a case is built: surfaces, places, fluxes, other runs.
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "meniscus/io/archive_file.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "tests/case/case_files.hpp"

namespace meniscus {
namespace {

using test::message_of;

constexpr const char* kQuiescent = "[flow]\nkind = \"quiescent\"\n";

/// Asserts that a message begins and goes on with the given parts, on one line.
void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  ASSERT_FALSE(parts.empty());
  EXPECT_TRUE(message.starts_with(parts.front())) << message;
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(BadScene, DropReachingBeyondItsDomainIsNamed) {
  const std::string drop = std::string(kQuiescent) + "[[drop]]\nradius = 1\n";
  expect_parts(message_of(drop + "[domain]\nhalf-width = 0.5\n"),
               {"case.toml:6: domain.half-width = 0.5 must exceed the reach of drop 0, 0.99",
                " (unit: R0)"});
  expect_parts(message_of(drop + "[domain]\nhalf-widths = [2, 2, 0.9]\n"),
               {"case.toml:6: domain.half-widths = [2.0, 2.0, 0.9] must exceed the reach of drop "
                "0, 0.98"});
}

TEST(BadScene, DropOutsideOrTouchingTheWallIsNamed) {
  const std::string drop = std::string(kQuiescent) + "[[drop]]\nradius = 1\n";
  expect_parts(message_of(drop + "[domain]\nshape = \"sphere\"\nradius = 0.9\n"),
               {"case.toml:7: domain.radius = 0.9 must exceed the reach of drop 0, 1.0"});
  expect_parts(message_of(drop + "center = [30, 0, 0]\n"),
               {"case.toml:3: drop 0 reaches 3",
                " from the origin, and domain.half-width is 10 by default (unit: R0)"});
  expect_parts(
      message_of(drop + "[domain]\nshape = \"cylinder\"\nradius = 3.0\nhalf-length = 0.9\n"),
      {"case.toml:8: domain.half-length = 0.9 must exceed the reach of drop 0, 0.99"});
  // Inside the sphere, but not inside its fifty-odd flat faces.
  expect_parts(message_of(drop + "center = [0.48, 0, 0]\n"
                                 "[domain]\nshape = \"sphere\"\nradius = 1.5\nnodes = 50\n"),
               {"case.toml:3: drop 0 "});
}

TEST(BadScene, OverlappingDropsAreNamed) {
  const std::string two = std::string(kQuiescent) +
                          "[[drop]]\nradius = 1\n[[drop]]\nradius = 1\ncenter = [1.5, 0, 0]\n";
  expect_parts(message_of(two), {"case.toml:5: drops 0 and 1 touch: ", "near ("});
  const std::string partly_inside =
      std::string(kQuiescent) +
      "[[drop]]\nradius = 2\n[[drop]]\nradius = 1\ncenter = [1.5, 0, 0]\n";
  expect_parts(message_of(partly_inside), {"case.toml:5: drops 0 and 1 touch: ", "near ("});
}

std::string file_case(const std::string& file) {
  return std::string(kQuiescent) + "[[drop]]\nsurface = \"" + file + "\"\n";
}

TEST(BadScene, UnclosedSurfaceIsRefused) {
  const test::TemporaryFolder folder;
  SurfaceMesh mesh = sphere(100);
  std::vector<FaceVertices> faces(mesh.faces.begin(), mesh.faces.end());
  faces.pop_back();
  mesh.faces = FaceField<FaceVertices>(faces);
  folder.write_stl("open.stl", mesh);
  expect_parts(message_of(file_case("open.stl"), {}, folder.path()),
               {"case.toml:4: drop.surface = \"open.stl\" is unfit: ", "closed"});
}

TEST(BadScene, SurfaceTooCoarseForCurvedFacesIsRefused) {
  const test::TemporaryFolder folder;
  folder.write("needle.off",
               "OFF\n6 8 0\n1e5 0 0\n-1e-9 0 0\n0 1e-9 0\n0 -1e-9 0\n0 0 1e-9\n0 0 -1e-9\n"
               "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n");
  expect_parts(message_of(file_case("needle.off"), {}, folder.path()),
               {"case.toml:3: drop 0 needs a finer surface: its faces enclose ", "curved"});
}

TEST(BadScene, TheLaterDropOfAConflictIsNamed) {
  const std::string drop = "[[drop]]\nradius = 1\n";
  expect_parts(
      message_of(kQuiescent + drop + drop + "center = [5, 0, 0]\n" + drop + "center = [1, 0, 0]\n"),
      {"case.toml:8: drops 0 and 2 touch: "});
  // Inside the sphere, but not inside its fifty-odd flat faces.
  expect_parts(message_of(kQuiescent + drop + "center = [-3, 0, 0]\n" + drop +
                          "center = [3.9, 0, 0]\n[domain]\nshape = \"sphere\"\nradius = 5\n"
                          "nodes = 50\n"),
               {"case.toml:6: drop 1 "});
}

/// Two spheres, the second one `offset` away, in one mesh.
SurfaceMesh two_spheres(double radius, double inner, const Vec3& offset) {
  SurfaceMesh mesh = sphere(100, radius);
  const SurfaceMesh second = sphere(100, inner, offset);
  const std::int32_t first = mesh.num_vertices();
  for (const Vec3& x : second.x) mesh.x.add(x);
  for (const FaceVertices& f : second.faces)
    mesh.faces.add(
        {VertexId{f[0].value + first}, VertexId{f[1].value + first}, VertexId{f[2].value + first}});
  return mesh;
}

TEST(BadScene, SurfacesInTwoPiecesAreRefused) {
  const test::TemporaryFolder folder;
  folder.write_stl("two.stl", two_spheres(1.0, 1.0, Vec3(5, 0, 0)));
  expect_parts(message_of(file_case("two.stl"), {}, folder.path()),
               {"case.toml:4: drop.surface = \"two.stl\" is unfit: surface is in more than one "
                "piece: vertex ",
                " at ("});
  folder.write_stl("tanks.stl", two_spheres(5.0, 5.0, Vec3(20, 0, 0)));
  expect_parts(message_of(std::string(kQuiescent) +
                              "[[drop]]\nradius = 1\n[domain]\nsurface = \"tanks.stl\"\n"
                              "[[domain.patch]]\ntag = 0\n",
                          {}, folder.path()),
               {"case.toml:6: domain.surface = \"tanks.stl\" is unfit: surface is in more than one "
                "piece: "});
}

TEST(BadScene, VerticesThatAreNotFiniteAreNamed) {
  const test::TemporaryFolder folder;
  const std::string tetrahedron =
      "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 {}\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  for (const char* value : {"nan", "inf"}) {
    folder.write("drop.obj", fmt::format(fmt::runtime(tetrahedron), value));
    expect_parts(
        message_of(file_case("drop.obj"), {}, folder.path()),
        {"case.toml:4: drop.surface = \"drop.obj\" cannot be used: ", "point 3", "not finite"});
  }
  for (const double value :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    SurfaceMesh mesh = sphere(100);
    mesh.x[VertexId{12}].x() = value;
    folder.write_stl("drop.stl", mesh);
    expect_parts(message_of(file_case("drop.stl"), {}, folder.path()),
                 {"case.toml:4: drop.surface = \"drop.stl\" cannot be used: ", "not finite"});
  }
}

TEST(BadScene, SelfIntersectingSurfaceIsRefused) {
  const test::TemporaryFolder folder;
  SurfaceMesh mesh = sphere(200);
  for (Vec3& x : mesh.x)
    if (x.x() > 0.8) x.x() -= 2.5;  // one cap is pushed out through the other side
  folder.write_stl("crossing.stl", mesh);
  expect_parts(message_of(file_case("crossing.stl"), {}, folder.path()),
               {"case.toml:4: drop.surface = \"crossing.stl\" is unfit: "});
}

TEST(BadScene, UnreadableSurfaceFilesAreNamed) {
  const test::TemporaryFolder folder;
  folder.write("empty.stl", "");
  folder.write("noise.ply", "no surface at all");
  folder.write("drop.xyz", "0 0 0");
  for (const char* file : {"empty.stl", "noise.ply", "drop.xyz"})
    expect_parts(message_of(file_case(file), {}, folder.path()),
                 {std::string("case.toml:4: drop.surface = \"") + file + "\" cannot be used: "});
}

TEST(BadScene, ForeignRunFoldersAreNamed) {
  const test::TemporaryFolder folder;
  const std::string text = std::string(kQuiescent) + "[[drop]]\nfrom-run = \".\"\n";
  EXPECT_EQ(message_of(text, {}, folder.path()),
            "case.toml:4: drop.from-run = \".\" holds no run: no checkpoint-<step>.h5 in the "
            "folder");
  folder.write("checkpoint-7.h5", "not ours");
  expect_parts(message_of(text, {}, folder.path()),
               {"case.toml:4: drop.from-run = \".\" cannot be used: ", "checkpoint-7.h5"});
  Archive foreign;
  foreign.reals["something/else"] = {1.0};
  io::write_archive(folder.path() / "checkpoint-8.h5", foreign);
  EXPECT_EQ(message_of(text, {}, folder.path()),
            "case.toml:4: drop.from-run = \".\" holds a checkpoint without a drop");
  folder.write("file.h5", "");
  EXPECT_EQ(
      message_of(std::string(kQuiescent) + "[[drop]]\nfrom-run = \"file.h5\"\n", {}, folder.path()),
      "case.toml:4: drop.from-run = \"file.h5\" is not a folder");
}

TEST(BadScene, NetInflowWithoutAnOpenPatchIsRefused) {
  const std::string tube = std::string(kQuiescent) +
                           "[[drop]]\nradius = 1\n[domain]\nshape = \"cylinder\"\nradius = 3.0\n"
                           "half-length = 4.0\n";
  const std::string inlet = "[[domain.patch]]\nname = \"x-\"\nvelocity = [1, 0, 0]\n";
  expect_parts(message_of(tube + inlet),
               {"case.toml:9: domain.patch: at t = 0 the imposed velocities carry ",
                " in in sum; "
                "make them balance or one patch open"});
  EXPECT_EQ(message_of(tube + inlet + "[[domain.patch]]\nname = \"x+\"\ncondition = \"open\"\n"),
            "no error");
  // Half the parabola's peak carries the same flux uniformly, to the error of interpolation.
  EXPECT_EQ(message_of(tube + "[[domain.patch]]\nname = \"x-\"\nvelocity = [1, 0, 0]\n"
                              "profile = \"parabolic\"\n[[domain.patch]]\nname = \"x+\"\n"
                              "velocity = [1, 0, 0]\nprofile = \"parabolic\"\n"),
            "no error");
}

TEST(BadScene, SymmetryOnACurvedPatchIsRefused) {
  const std::string patch = "[[domain.patch]]\nname = \"side\"\ncondition = \"symmetry\"\n";
  EXPECT_EQ(message_of(std::string(kQuiescent) +
                       "[[drop]]\nradius = 1\n[domain]\nshape = \"cylinder\"\n" + patch),
            "case.toml:9: domain.patch.condition = \"symmetry\" needs a flat patch, which this one "
            "is not");
}

TEST(BadScene, NetInflowThatAScheduleBringsIsRefused) {
  // The x-faces are walls: harmless at rest, but the extension then only takes liquid in.
  const std::string walls =
      "[[domain.patch]]\nname = \"x-\"\nvelocity = [0, 0, 0]\n"
      "[[domain.patch]]\nname = \"x+\"\nvelocity = [0, 0, 0]\n";
  const std::string start =
      "[[flow.schedule]]\ntime = 2\nramp = 1\nkind = \"uniaxial-extension\"\n";
  const std::string base = std::string(kQuiescent) + "[[drop]]\nradius = 1\n";
  EXPECT_EQ(message_of(base + walls), "no error");
  expect_parts(message_of(base + walls + start), {"case.toml:5: domain.patch: at t = 3 "});
}

}  // namespace
}  // namespace meniscus
