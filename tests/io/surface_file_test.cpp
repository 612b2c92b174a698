#include "meniscus/io/surface_file.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/binary.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus::io {
namespace {

using test::get;
using test::message_of;
using test::put;

/// Reads text as a file of the given extension.
RepairedSurface read_text(const std::string& extension, std::string_view text) {
  const test::TemporaryFolder folder;
  put(folder / ("s" + extension), text);
  return read_surface(folder / ("s" + extension));
}

/// What is said of a file, without its folder.
std::string complaint(const std::string& extension, std::string_view text) {
  const test::TemporaryFolder folder;
  put(folder / ("s" + extension), text);
  const std::string message =
      message_of<InvalidInput>([&] { (void)read_surface(folder / ("s" + extension)); });
  return message.substr(std::min(message.size(), folder.path().string().size() + 1));
}

/// The regular tetrahedron's corners and faces in four hands.
constexpr std::string_view tetrahedron_off = R"(OFF
# corners of a cube
4 4 6
 1 1 1
 1 -1 -1   0.5 0.5 0.5
-1 1 -1
-1 -1 1
3 0 1 2
3 0 3 1  200 0 0
3 0 2 3
3 1 3 2
)";

TEST(SurfaceFile, DoublesComeBackFromEveryFormatThatHasThem) {
  const test::TemporaryFolder folder;
  const SurfaceMesh mesh = stretched_sphere(150, Vec3(1.0, 1.0 / 3.0, 2e-7), Vec3(1e5, 0, 0));
  for (const char* name : {"s.ply", "s.obj", "s.off", "s.vtp", "S.OFF"}) {
    write_surface(folder / name, mesh);
    const TaggedSurface back = read_surface(folder / name);
    EXPECT_EQ(back.mesh, mesh) << name;
    EXPECT_EQ(back.tag, FaceField<int>(mesh.num_faces(), 0)) << name;
    const std::string bytes = get(folder / name);
    write_surface(folder / name, mesh);
    EXPECT_EQ(get(folder / name), bytes) << name;
  }
}

TEST(SurfaceFile, StlKeepsShapeAndTopologyToSinglePrecision) {
  const test::TemporaryFolder folder;
  const SurfaceMesh mesh = sphere(150);
  write_surface(folder / "s.stl", mesh);
  EXPECT_EQ(std::filesystem::file_size(folder / "s.stl"), 84U + 50U * 296U);
  const SurfaceMesh back = read_surface(folder / "s.stl").mesh;
  ASSERT_EQ(back.num_vertices(), mesh.num_vertices());
  ASSERT_EQ(back.num_faces(), mesh.num_faces());
  for (const FaceId f : mesh.faces.ids()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 error = back.x[back.faces[f][k]] - mesh.x[mesh.faces[f][k]];
      EXPECT_LE(error.cwiseAbs().maxCoeff(), std::ldexp(1.0, -25));  // half a unit of a float at 1
    }
  }
}

TEST(SurfaceFile, ReadsOff) {
  const TaggedSurface surface = read_text(".off", tetrahedron_off);
  EXPECT_EQ(surface.mesh.num_vertices(), 4);
  EXPECT_NEAR(enclosed_volume(surface.mesh), 8.0 / 3.0, 1e-15);
  EXPECT_EQ(read_text(".off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2").mesh.num_faces(), 1);
}

TEST(SurfaceFile, ReadsAsciiStlWithASolidPerTag) {
  const auto facet = [](const char* corners) {
    return fmt::format("facet normal 0 0 0\n outer loop\n{} endloop\nendfacet\n", corners);
  };
  const std::string a = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
  const std::string b = facet("vertex 0 1 -0\nvertex 1 0 0\nvertex 1 1e0 +0.5\n");
  const TaggedSurface surface =
      read_text(".stl", "solid wall\n" + a + "endsolid wall\nsolid end\n" + b + "endsolid\n");
  EXPECT_EQ(surface.mesh.num_vertices(), 4);  // −0 and 0 are one point
  EXPECT_EQ(surface.tag, FaceField<int>(std::vector<int>{0, 1}));
  EXPECT_EQ(surface.mesh.x[VertexId{3}], Vec3(1, 1, 0.5));
}

/// Facets each of which has its corners a little elsewhere than its neighbours have them.
std::string facets_apart(const SurfaceMesh& mesh, double distance) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> shift(-distance, distance);
  std::string text = "solid\n";
  for (const FaceVertices& face : mesh.faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const VertexId v : face)
      text += fmt::format("vertex {} {} {}\n", mesh.x[v].x() + shift(random),
                          mesh.x[v].y() + shift(random), mesh.x[v].z() + shift(random));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

TEST(SurfaceFile, StlFacetsMeetThatRoundingPutApart) {
  const SurfaceMesh mesh = sphere(150);
  for (const double distance : {1e-16, 1e-9, 4e-7}) {
    const SurfaceMesh back = read_text(".stl", facets_apart(mesh, distance)).mesh;
    EXPECT_EQ(back.num_vertices(), mesh.num_vertices()) << distance;
    EXPECT_EQ(back.num_faces(), mesh.num_faces()) << distance;
    EXPECT_NEAR(enclosed_volume(back), enclosed_volume(mesh), 20.0 * distance + 1e-12);
  }
  // Farther apart they are edges of their own.
  EXPECT_EQ(read_text(".stl", facets_apart(mesh, 1e-4)).mesh.num_vertices(), 3 * mesh.num_faces());
}

TEST(SurfaceFile, StlFacetsWithoutAWidthAreDropped) {
  const auto facet = [](const char* corners) {
    return fmt::format("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", corners);
  };
  const TaggedSurface surface = read_text(
      ".stl", "solid a\n" + facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n") +
                  facet("vertex 0 0 0\nvertex 1e-9 0 0\nvertex 0 1 0\n") + "endsolid a\nsolid b\n" +
                  facet("vertex 0 1 0\nvertex 1 0 0\nvertex 1 1 1\n") + "endsolid b\n");
  EXPECT_EQ(surface.mesh.num_faces(), 2);
  EXPECT_EQ(surface.tag, FaceField<int>(std::vector<int>{0, 1}));
}

TEST(SurfaceFile, ReadsBinaryStlThatBeginsWithSolid) {
  std::string bytes = "solid by a program that should not";
  bytes.resize(80, ' ');
  store(bytes, std::uint32_t{1});
  for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 3.F, 0.F})
    store(bytes, value);
  store(bytes, std::uint16_t{0});
  EXPECT_NEAR(surface_area(read_text(".stl", bytes).mesh), 3.0, 1e-15);
}

TEST(SurfaceFile, ReadsObjWithGroupsAndAllKindsOfCorner) {
  const TaggedSurface surface = read_text(".obj", R"(# by hand
mtllib some.mtl
v 0 0 0
v 1 0 0 1.0
v 0 1 0
v 0 0 1
vn 0 0 1
vt 0 0
g unused
g side extra
usemtl steel
f 1/1/1 2/1/1 3/1/1
g end
f 1//1 2//1 4//1
g side
s off
f -4 -3 -1
v 9 9 9
)");
  EXPECT_EQ(surface.mesh.num_vertices(), 4);  // the point that no face uses is left out
  EXPECT_EQ(surface.tag, FaceField<int>(std::vector<int>{0, 1, 0}));
  EXPECT_EQ(surface.mesh.faces[FaceId{1}], surface.mesh.faces[FaceId{2}]);
}

TEST(SurfaceFile, ReadsPlyOfEveryEncoding) {
  const std::string header = R"(
comment by hand
element vertex 3
property float x
property double y
property short z
property uchar red
element edge 1
property int a
property list uchar float weights
element face 1
property uchar flag
property list int ushort vertex_index
end_header
)";
  const auto check = [](const TaggedSurface& surface) {
    EXPECT_EQ(surface.mesh.x[VertexId{1}], Vec3(0.5, 2.5, -3));
    EXPECT_EQ(surface.mesh.faces[FaceId{0}][1].value, 2);
  };
  check(read_text(".ply", "ply\nformat ascii 1.0" + header +
                              "0 0 0 255\n0.5 2.5 -3 0\n1 0\n1 9\n7 2 0.5 0.25\n1 3 0 2 1\n"));
  std::string body;
  const auto vertex = [&](float x, double y, std::int16_t z) {
    store(body, x), store(body, y), store(body, z), store(body, std::uint8_t{255});
  };
  vertex(0, 0, 0), vertex(0.5F, 2.5, -3), vertex(1, 0, 1);
  store(body, std::int32_t{7}), store(body, std::uint8_t{2}), store(body, 0.5F), store(body, 0.25F);
  store(body, std::uint8_t{1}), store(body, std::int32_t{3});
  for (const int corner : {0, 2, 1}) store(body, static_cast<std::uint16_t>(corner));
  check(read_text(".ply", "ply\nformat binary_little_endian 1.0" + header + body));
}

TEST(SurfaceFile, ReadsBigEndianPly) {
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty int x\n"
      "property int y\nproperty int z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (const char c : std::initializer_list<char>{1, 0, 0, 0, 2, 0, 0, 0, 3})
    text.append(3, 0).append(1, c);
  text += '\3';
  for (const char c : std::initializer_list<char>{0, 1, 2}) text.append(3, 0).append(1, c);
  EXPECT_EQ(read_text(".ply", text).mesh.x[VertexId{2}], Vec3(0, 0, 3));
}

TEST(SurfaceFile, ReadsPatchesOfAVtpInAscii) {
  const std::string begin = R"(<VTKFile type="PolyData" version="0.1"><PolyData>
<Piece NumberOfPoints="3" NumberOfPolys="2"><Points><DataArray type="Float32"
NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 2 1 0</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6</DataArray></Polys>
<CellData><DataArray type="Float32" Name="patch" format="ascii">)";
  const std::string end = "</DataArray></CellData></Piece></PolyData></VTKFile>";
  EXPECT_EQ(read_text(".vtp", begin + "2 5" + end).tag, FaceField<int>(std::vector<int>{2, 5}));
  EXPECT_EQ(complaint(".vtp", begin + "2 0.5" + end),
            "s.vtp: patch = 0.5 is not a whole number from 0 on");
  EXPECT_EQ(complaint(".vtp", begin + "2" + end),
            "s.vtp: not a surface file of VTK (.vtp), or corrupt");
}

TEST(SurfaceFile, FacesOfMoreCornersAreReadFromEveryFormat) {
  // A pyramid over a square, of area 4 · 1/2 · 2√2 + 4 and volume 4/3.
  constexpr std::string_view points = "1 1 0\n-1 1 0\n-1 -1 0\n1 -1 0\n0 0 1\n";
  constexpr std::string_view faces = "4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  const auto expect_pyramid = [](const RepairedSurface& surface) {
    EXPECT_EQ(surface.mesh.num_faces(), 6);
    EXPECT_NEAR(enclosed_volume(surface.mesh), 4.0 / 3.0, 1e-15);
    EXPECT_EQ(surface.report.polygons, 1);
  };
  expect_pyramid(read_text(".off", fmt::format("OFF\n5 5 0\n{}{}", points, faces)));
  expect_pyramid(
      read_text(".ply", fmt::format("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
                                    "property float y\nproperty float z\nelement face 5\n"
                                    "property list uchar int vertex_indices\nend_header\n{}{}",
                                    points, faces)));
  expect_pyramid(read_text(".obj",
                           "v 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\nv 0 0 1\n"
                           "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"));
  expect_pyramid(read_text(
      ".vtp",
      R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData><Piece NumberOfPoints="5" NumberOfPolys="5"><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
1 1 0 -1 1 0 -1 -1 0 1 -1 0 0 0 1</DataArray></Points><Polys>
<DataArray type="Int64" Name="connectivity" format="ascii">
3 2 1 0 0 1 4 1 2 4 2 3 4 3 0 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 7 10 13 16</DataArray>
</Polys></Piece></PolyData></VTKFile>)"));
}

TEST(SurfaceFile, SaysWhatIsWrong) {
  EXPECT_EQ(complaint(".txt", ""),
            "s.txt: unknown kind of surface file; known are .stl, .ply, .obj, .off, .vtp and .vtu");
  EXPECT_EQ(complaint(".obj", "v 0 0 0\n"), "s.obj: holds no faces");
  EXPECT_EQ(complaint(".obj", "v 0 0 x\n"), "s.obj:1: `x` is not a number");
  EXPECT_EQ(complaint(".obj", "v 0 0\n"), "s.obj:1: 3 words where more are expected");
  EXPECT_EQ(complaint(".obj", "v 0 0 0\n\nf 1 1\n"),
            "s.obj:3: a face of 2 corners; a face has at least 3");
  EXPECT_EQ(complaint(".obj", "f 0 1 2\n"), "s.obj:1: a corner names point 0; points count from 1");
  EXPECT_EQ(complaint(".obj", "v 0 0 0\nf 1 1 2\n"),
            "s.obj: face 0 has the point 1; the file has 1 points");
  EXPECT_EQ(complaint(".obj", "f 1.5 1 2\n"), "s.obj:1: `1.5` is not a whole number");
  EXPECT_EQ(complaint(".obj", "v 0 nan 0\nf 1 1 1\n"),
            "s.obj: point 0 has a coordinate that is not finite");
  EXPECT_EQ(complaint(".off", ""), "s.off:0: the file ends where `OFF` is expected");
  EXPECT_EQ(complaint(".off", "OBJ\n"), "s.off:1: not an OFF file");
  EXPECT_EQ(complaint(".off", "OFF\n1 1 0\n0 0 0\n2 0 0\n"),
            "s.off:4: a face of 2 corners; a face has at least 3");
  EXPECT_EQ(complaint(".off", "OFF\n2 1 0\n0 0 0\n"),
            "s.off:3: the file ends where a point is expected");
  EXPECT_EQ(
      complaint(".stl", "hello"),
      "s.stl: not an STL file, or cut short: neither begins with `solid` nor has the length of "
      "a binary one");
  EXPECT_EQ(complaint(".stl", "solid\nvertex 0 0 0\nendfacet\n"),
            "s.stl:3: a face of 1 corners; a face has at least 3");
  EXPECT_EQ(complaint(".stl", "solid\nfacett\n"), "s.stl:2: `facett` is no keyword of STL");
  EXPECT_EQ(complaint(".stl", "solid\n"), "s.stl:1: the file ends where `endsolid` is expected");
  EXPECT_EQ(complaint(".ply", "plyx\n"), "s.ply:1: not a PLY file");
  EXPECT_EQ(complaint(".ply", "ply\nformat odd 1.0\n"), "s.ply:2: unknown format of PLY");
  EXPECT_EQ(complaint(".ply", "ply\nproperty int x\n"), "s.ply:2: a property without an element");
  EXPECT_EQ(complaint(".ply", "ply\nelement vertex\n"), "s.ply:2: an element that is not of PLY");
  EXPECT_EQ(complaint(".ply", "ply\nelement vertex 1\nproperty int\n"),
            "s.ply:3: a property that is not of PLY");
  EXPECT_EQ(complaint(".ply", "ply\nelement vertex 1\nproperty real x\n"),
            "s.ply:3: `real` is no type of PLY");
  EXPECT_EQ(complaint(".ply", "ply\nelement vertex 1\nproperty int x\n"),
            "s.ply:3: the file ends where `end_header` is expected");
  EXPECT_EQ(complaint(".ply",
                      "ply\nformat binary_little_endian 1.0\nelement vertex 9\n"
                      "property int x\nend_header\nxx"),
            "s.ply:5: the file is cut short after its header");
  EXPECT_EQ(complaint(".ply",
                      "ply\nformat ascii 1.0\nelement face 1\n"
                      "property list int int vertex_indices\nend_header\n2 0 0\n"),
            "s.ply:6: a face of 2 corners; a face has at least 3");
  EXPECT_EQ(complaint(".ply",
                      "ply\nformat ascii 1.0\nelement face 1\n"
                      "property list int int vertex_indices\nend_header\n-1\n"),
            "s.ply:6: a list of -1 numbers");
  EXPECT_EQ(complaint(".ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\n"
                      "property list int int x\nend_header\n1 1\n"),
            "s.ply:5: the vertices have a list `x`");
}

TEST(SurfaceFile, BinaryRubbishIsShownOnOneLine) {
  const std::string message = complaint(".off", std::string("OFF 1 1\n\x01\x1b") + "[31m 1 1\n");
  EXPECT_EQ(message, "s.off:2: `??[31m` is not a number");
  EXPECT_EQ(complaint(".off", "OFF 1 1\n" + std::string(50, 'x') + " 1 1\n"),
            "s.off:2: `" + std::string(40, 'x') + "...` is not a number");
}

/// Whatever bytes a file has, it is read or refused: nothing else is thrown, nothing crashes.
TEST(SurfaceFile, AnyDamageIsReadOrRefused) {
  const test::TemporaryFolder folder;
  std::mt19937 random(11);
  for (const char* name : {"s.stl", "s.ply", "s.obj", "s.off", "s.vtp"}) {
    write_surface(folder / name, sphere(20));
    const std::string whole = get(folder / name);
    int num_refused = 0;
    for (int i = 0; i < 150; ++i) {
      std::string broken =
          whole.substr(0, random() % 4 == 0 ? random() % whole.size() : whole.size());
      for (int k = 0; k < 3 && !broken.empty(); ++k) {
        broken[random() % std::min<std::size_t>(broken.size(), 400)] = static_cast<char>(random());
      }
      put(folder / name, broken);
      try {
        (void)read_surface(folder / name);
      } catch (const InvalidInput& refusal) {
        ++num_refused;
        EXPECT_EQ(std::string_view(refusal.what()).find('\n'), std::string_view::npos);
      }
    }
    EXPECT_GT(num_refused, 15) << name;
  }
}

TEST(SurfaceFile, FullDiskIsNoticed) {
  const test::TemporaryFolder folder;
  for (const char* name : {"s.stl", "s.ply", "s.obj", "s.off", "s.vtp"}) {
    EXPECT_TRUE(test::holds_on_full_disk(600, [&] {
      return message_of<RunFailure>([&] { write_surface(folder / name, sphere(100)); }) ==
             (folder / name).string() + ": cannot be written: File too large";
    })) << name;
  }
  EXPECT_EQ(folder.num_entries(), 0);
}

}  // namespace
}  // namespace meniscus::io
