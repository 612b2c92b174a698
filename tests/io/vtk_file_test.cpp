#include "meniscus/io/vtk_file.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus::io {
namespace {

using test::get;
using test::message_of;
using test::put;

MeshData example_data(const SurfaceMesh& mesh) {
  NamedArray kappa{.name = "kappa", .components = 1, .values = {}};
  NamedArray velocity{.name = "velocity", .components = 3, .values = {}};
  for (const Vec3& x : mesh.x) {
    kappa.values.push_back(x.squaredNorm() / 3.0);
    velocity.values.insert(velocity.values.end(), {x[1], 0.0, -x[0]});
  }
  kappa.values[0] = std::numeric_limits<double>::infinity();
  NamedArray drop{.name = "drop", .components = 1, .values = {}};
  drop.values.assign(static_cast<std::size_t>(mesh.num_faces()), 4.0);
  return {.on_vertices = {kappa, velocity}, .on_cells = {drop}};
}

void write_example(const std::filesystem::path& path) {
  const SurfaceMesh mesh = sphere(40);
  const SurfaceMesh* const surfaces[] = {&mesh};
  write_vtp(path, surfaces, example_data(mesh), 0.7);
}

TEST(VtkFile, SurfaceWithArraysComesBackTheSame) {
  const test::TemporaryFolder folder;
  const SurfaceMesh mesh = sphere(40);
  write_example(folder / "s.vtp");
  const SurfaceFrame frame = read_surface_frame(folder / "s.vtp");
  EXPECT_EQ(frame.mesh, mesh);
  const MeshData expected = example_data(mesh);
  ASSERT_EQ(frame.data.on_vertices.size(), 2U);
  ASSERT_EQ(frame.data.on_cells.size(), 1U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(frame.data.on_vertices[i].name, expected.on_vertices[i].name);
    EXPECT_EQ(frame.data.on_vertices[i].components, expected.on_vertices[i].components);
    EXPECT_EQ(frame.data.on_vertices[i].values, expected.on_vertices[i].values);
  }
  EXPECT_EQ(frame.data.on_cells[0].values, expected.on_cells[0].values);
}

TEST(VtkFile, SeveralSurfacesShareOneFile) {
  const test::TemporaryFolder folder;
  const SurfaceMesh a = sphere(20), b = sphere(30, 0.5, Vec3(3, 0, 0));
  const SurfaceMesh* const surfaces[] = {&a, &b};
  write_vtp(folder / "s.vtp", surfaces, {}, 0.0);
  const SurfaceFrame frame = read_surface_frame(folder / "s.vtp");
  ASSERT_EQ(frame.mesh.num_vertices(), 50);
  ASSERT_EQ(frame.mesh.num_faces(), a.num_faces() + b.num_faces());
  EXPECT_EQ(frame.mesh.x[VertexId{20}], b.x[VertexId{0}]);
  const FaceVertices first_of_b = frame.mesh.faces[FaceId{a.num_faces()}];
  EXPECT_EQ(first_of_b[0].value, b.faces[FaceId{0}][0].value + 20);
}

TEST(VtkFile, SameSurfaceGivesTheSameBytes) {
  const test::TemporaryFolder folder;
  write_example(folder / "a.vtp");
  write_example(folder / "b.vtp");
  EXPECT_EQ(get(folder / "a.vtp"), get(folder / "b.vtp"));
}

TetMesh two_cells() {
  TetMesh mesh;
  for (const Vec3& x :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)}) {
    mesh.x.add(x);
  }
  const auto v = [](int i) { return TetVertexId{i}; };
  mesh.cells.add({v(0), v(1), v(2), v(3)});
  mesh.cells.add({v(1), v(2), v(3), v(4)});
  mesh.region = CellField<RegionId>(2, RegionId{0});
  return mesh;
}

TEST(VtkFile, CellsShareVerticesUnlessAFieldJumps) {
  const test::TemporaryFolder folder;
  const MeshData data{.on_vertices = {{"height", 1, {0, 0, 0, 1, 1}}},
                      .on_cells = {{"phase", 1, {0, 1}}}};
  write_vtu(folder / "shared.vtu", two_cells(), data, 0.5);
  EXPECT_NE(get(folder / "shared.vtu").find("NumberOfPoints=\"5\""), std::string::npos);
  const NamedArray pressure[] = {{"pressure", 1, {1, 1, 1, 1, 2, 2, 2, 2}}};
  write_vtu(folder / "own.vtu", two_cells(), data, 0.5, pressure);
  const std::string text = get(folder / "own.vtu");
  EXPECT_NE(text.find("NumberOfPoints=\"8\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfCells=\"2\""), std::string::npos);
  for (const char* name : {"height", "pressure", "phase", "TimeValue"}) {
    EXPECT_NE(text.find(std::string("Name=\"") + name + '"'), std::string::npos) << name;
  }
}

/// A sphere whose edges are curved, with one value known at their middles, their heights.
struct CurvedSphere {
  SurfaceMesh mesh = sphere(40);
  CurvedEdges curved;

  CurvedSphere() {
    NamedArray height{.name = "height", .components = 1, .values = {}};
    const SurfaceTopology topology(mesh);
    for (const SurfaceEdge& edge : topology.edges()) {
      curved.ends.push_back({edge.b.value, edge.a.value});  // in any order
      curved.middles.push_back((mesh.x[edge.a] + mesh.x[edge.b]).normalized());
      height.values.push_back(curved.middles.back().z());
    }
    curved.values = {height};
  }
  void write(const std::filesystem::path& path) const {
    const SurfaceMesh* const surfaces[] = {&mesh};
    MeshData data = example_data(mesh);
    NamedArray& height = data.on_vertices.emplace_back(NamedArray{"height", 1, {}});
    for (const Vec3& x : mesh.x) height.values.push_back(x.z());
    write_surface_vtu(path, surfaces, data, 0.7, curved);
  }
};

TEST(VtkFile, CurvedSurfaceComesBackTheSame) {
  const test::TemporaryFolder folder;
  const CurvedSphere sphere;
  sphere.write(folder / "s.vtu");
  const SurfaceFrame frame = read_surface_frame(folder / "s.vtu");
  EXPECT_EQ(frame.mesh, sphere.mesh);
  ASSERT_EQ(frame.middles.size(), frame.mesh.num_faces());
  for (const FaceId f : frame.mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const FaceVertices& v = frame.mesh.faces[f];
      const Vec3 sum = frame.mesh.x[v[k]] + frame.mesh.x[v[(k + 1) % 3]];
      EXPECT_EQ(frame.middles[f][k], sum.normalized());
    }
  const MeshData expected = example_data(frame.mesh);
  ASSERT_EQ(frame.data.on_vertices.size(), 3U);
  EXPECT_EQ(frame.data.on_vertices[0].values, expected.on_vertices[0].values);
  EXPECT_EQ(frame.data.on_vertices[1].values, expected.on_vertices[1].values);
  EXPECT_EQ(frame.data.on_cells[0].values, expected.on_cells[0].values);
  const PolygonSoup soup = read_polygons(folder / "s.vtu");  // corners alone
  EXPECT_EQ(soup.points, std::vector<Vec3>(frame.mesh.x.begin(), frame.mesh.x.end()));
  EXPECT_EQ(soup.num_faces(), static_cast<std::size_t>(frame.mesh.num_faces()));
}

/// The values of an array where a cell's edges have their middles.
std::vector<double> at_middles(const VolumeFrame& frame, std::size_t cell, std::string_view name) {
  const auto array = std::ranges::find(frame.data.on_vertices, name, &NamedArray::name);
  std::vector<double> values;
  for (const std::int32_t point : frame.middles[cell])
    values.push_back(array->values[static_cast<std::size_t>(point)]);
  return values;
}

// Of two cells one has a curved edge: it alone is quadratic, in a file of shared vertices and in
// one where the pressures at three vertices differ between the cells.
TEST(VtkFile, CellsWithACurvedEdgeAreQuadratic) {
  const test::TemporaryFolder folder;
  const MeshData data{.on_vertices = {{"height", 1, {0, 0, 0, 1, 1}}}, .on_cells = {}};
  const NamedArray pressure[] = {{"pressure", 1, {0, 2, 4, 6, 5, 5, 5, 5}}};
  const CurvedEdges curved{
      .ends = {{3, 0}}, .middles = {Vec3(-0.1, 0, 0.5)}, .values = {{"height", 1, {7.0}}}};
  for (const bool has_own_corners : {false, true}) {
    write_vtu(folder / "v.vtu", two_cells(), data, 0.5,
              std::span(pressure, has_own_corners ? 1 : 0), curved);
    const VolumeFrame frame = read_vtu(folder / "v.vtu");
    ASSERT_EQ(frame.cells.size(), 2U);
    ASSERT_EQ(frame.middles.size(), 2U);
    EXPECT_EQ(frame.middles[1], (std::array<std::int32_t, 6>{-1, -1, -1, -1, -1, -1}));
    const std::size_t corners = has_own_corners ? 5 + 3 : 5;
    EXPECT_EQ(frame.points.size(), corners + 6);
    const std::vector<Vec3> expected = {{0.5, 0, 0},    {0.5, 0.5, 0}, {0, 0.5, 0},
                                        {-0.1, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    for (std::size_t k = 0; k < 6; ++k) {
      const auto point = static_cast<std::size_t>(frame.middles[0][k]);
      EXPECT_GE(point, corners);
      EXPECT_EQ(frame.points[point], expected[k]);
    }
    EXPECT_EQ(at_middles(frame, 0, "height"), (std::vector<double>{0, 0, 0, 7, 0.5, 0.5}));
    if (has_own_corners) {
      EXPECT_EQ(at_middles(frame, 0, "pressure"), (std::vector<double>{1, 3, 2, 3, 4, 5}));
    }
  }
}

TEST(VtkFile, RefusesSurfacesOfOtherCells) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "s.vtu").string();
  write_vtu(path, two_cells(), {}, 0.0);
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)read_surface_frame(path); }),
            path + ": cell 0 is neither a triangle nor a quadrangle; only these are read");
  put(path, "torn");
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)read_surface_frame(path); }),
            path + ": not a surface file of VTK (.vtu), or corrupt");
}

TEST(VtkFile, FullDiskIsNoticed) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(test::holds_on_full_disk(500, [&] {
    return message_of<RunFailure>([&] { write_example(folder / "s.vtp"); }) ==
           (folder / "s.vtp").string() + ": cannot be written: File too large";
  }));
  EXPECT_EQ(folder.num_entries(), 0);
}

TEST(VtkFile, RefusesForeignAndTruncatedSurfaces) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "s.vtp").string();
  const auto reading = [&] {
    return message_of<InvalidInput>([&] { (void)read_surface_frame(path); });
  };
  const std::string expected = path + ": not a surface file of VTK (.vtp), or corrupt";
  for (const char* text : {"", "hello", "<html></html>", "<VTKFile type=\"UnstructuredGrid\"/>"}) {
    put(path, text);
    EXPECT_EQ(reading(), expected) << text;
  }
  write_example(path);
  const std::string whole = get(path);
  std::string untyped = whole;
  untyped.replace(untyped.find("type=\"Float64\""), 4, "tope");
  put(path, untyped);
  EXPECT_EQ(reading(), expected);
  const std::size_t data = whole.find("<AppendedData");
  for (std::size_t size = 0; size < data + 200; size += 97) {
    put(path, whole.substr(0, size));
    EXPECT_EQ(reading(), expected) << "cut at " << size;
  }
}

TEST(VtkFile, TimeSeriesComesBackTheSame) {
  const test::TemporaryFolder folder;
  const std::vector<PvdEntry> entries = {{0.0, "surface/0.vtp"}, {0.1 + 0.2, "a&b <\"c\">.vtp"}};
  write_pvd(folder / "s.pvd", entries);
  const std::vector<PvdEntry> back = read_pvd(folder / "s.pvd");
  ASSERT_EQ(back.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].t, entries[i].t);
    EXPECT_EQ(back[i].file, entries[i].file);
  }
  write_pvd(folder / "s.pvd", {});
  EXPECT_TRUE(read_pvd(folder / "s.pvd").empty());
}

TEST(VtkFile, RefusesForeignTimeSeries) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "s.pvd").string();
  const auto reading = [&](std::string_view text) {
    put(path, text);
    return message_of<InvalidInput>([&] { (void)read_pvd(path); });
  };
  for (const char* text : {"", "hello", "<VTKFile></VTKFile>", "<VTKFile><Collection>"}) {
    EXPECT_EQ(reading(text), path + ": not a time series of VTK (.pvd), or corrupt") << text;
  }
  EXPECT_EQ(reading("<VTKFile><Collection><DataSet timestep=\"1\"/></Collection></VTKFile>"),
            path + ": entry 0 has no file or no time");
}

}  // namespace
}  // namespace meniscus::io
