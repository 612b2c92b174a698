#include "meniscus/report/mesh_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/report/cut_area.hpp"
#include "tests/report/synthetic_run.hpp"

namespace meniscus::report {
namespace {

using test::area;
using test::message_of;
using test::put;

io::VolumeFrame box_frame(const test::TemporaryFolder& folder) {
  test::write_synthetic_run(folder.path(), {.num_frames = 1, .num_volume_frames = 1});
  return io::read_vtu(folder / "volume/volume-0000.vtu");
}

/// The polygons of a cut through a box tile its section: wherever it lies, also along facets.
TEST(MeshCut, PolygonsTileTheSection) {
  const test::TemporaryFolder folder;
  const io::VolumeFrame mesh = box_frame(folder);
  EXPECT_EQ(mesh.cells.size(), 12U * 12U * 12U * 6U);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-3.9, 3.9);
  for (int trial = 0; trial < 12; ++trial) {
    MeshCut cut;
    cut.normal = 1 + trial % 2;
    cut.offset = trial < 2 ? 0.0 : uniform(random);  // 0 is a plane of facets
    cut.low = {-5.0, -5.0};
    cut.high = {5.0, 5.0};
    add_polygons(cut, mesh);
    double total = 0.0;
    for (const CutPolygon& polygon : cut.polygons) total += area(cut, polygon);
    EXPECT_NEAR(total, 64.0, 1e-10) << "offset " << cut.offset;  // roundoff of some 1000 terms
  }
}

TEST(MeshCut, KnowsTheDropsOfItsRegions) {
  const test::TemporaryFolder folder;
  io::VolumeFrame mesh = box_frame(folder);
  EXPECT_EQ(cut_through_drops(mesh, 2).drops, std::vector<int>{0});
  const auto drop = std::ranges::find(mesh.data.on_cells, "drop", &io::NamedArray::name);
  const auto region = std::ranges::find(mesh.data.on_cells, "region", &io::NamedArray::name);
  region->values[0] = 3.0;  // after events: the third interface is of drop 7
  drop->values[0] = 7.0;
  EXPECT_EQ(cut_through_drops(mesh, 2).drops, (std::vector<int>{0, -1, 7}));
  mesh.data.on_cells.erase(drop);
  EXPECT_TRUE(cut_through_drops(mesh, 2).drops.empty());
}

/// Moves the middles of all edges within the box by up to `reach` in each direction.
void bend_edges(io::VolumeFrame& mesh, double reach) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-reach, reach);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
  for (const auto& cell : mesh.cells) {
    auto& middles = mesh.middles.emplace_back();
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [a, b] = std::minmax({cell[kEdges[k][0]], cell[kEdges[k][1]]});
      const auto [found, is_new] =
          known.try_emplace({a, b}, static_cast<std::int32_t>(mesh.points.size()));
      middles[k] = found->second;
      if (!is_new) continue;
      Vec3 x = 0.5 * (mesh.points[static_cast<std::size_t>(a)] +
                      mesh.points[static_cast<std::size_t>(b)]);
      if (x.cwiseAbs().maxCoeff() < 3.9)
        x += Vec3(uniform(random), uniform(random), uniform(random));
      mesh.points.push_back(x);
    }
  }
}

/// Sections of curved cells tile as those of flat ones do: neighbours see the same curved face.
TEST(MeshCut, PolygonsOfCurvedCellsTileTheSection) {
  const test::TemporaryFolder folder;
  io::VolumeFrame mesh = box_frame(folder);
  bend_edges(mesh, 0.05);  // of cells of edge 0.67
  for (const double offset : {0.0, 0.1234, -3.3}) {
    MeshCut cut;
    cut.offset = offset;
    cut.low = {-5.0, -5.0};
    cut.high = {5.0, 5.0};
    add_polygons(cut, mesh);
    double total = 0.0;
    int most_points = 0;
    for (const CutPolygon& polygon : cut.polygons) {
      total += area(cut, polygon);
      most_points = std::max(most_points, polygon.num_points);
    }
    EXPECT_NEAR(total, 64.0, 1e-5) << "offset " << offset;  // of turns below 1e-6 left out
    EXPECT_GT(most_points, 8);
  }
}

/// A quadratic map of one tetrahedron onto a part of a paraboloid's inside: x and y stay, and z
/// grows by x² − x at the middles of edges, as quadratic functions do everywhere.
TEST(MeshCut, SectionOfACurvedCellIsThatOfItsMap) {
  io::VolumeFrame mesh;
  mesh.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.cells = {{0, 1, 2, 3}};
  bend_edges(mesh, 0.0);
  for (Vec3& x : mesh.points) x.z() += 0.8 * (x.x() * x.x() - x.x());
  MeshCut cut;
  cut.normal = 2;
  cut.offset = 0.2;
  cut.low = {-2.0, -2.0};
  cut.high = {2.0, 2.0};
  add_polygons(cut, mesh);
  ASSERT_EQ(cut.polygons.size(), 1U);
  // z = c + 0.8 (x² − x), c from 0 to 1 − x − y: 0 ≤ y ≤ 1 − x − c with c = 0.2 + 0.8 (x − x²).
  double expected = 0.0;
  constexpr int kSlices = 10000;
  for (int i = 0; i < kSlices; ++i) {
    const double x = (i + 0.5) / kSlices;
    expected += std::max(0.0, 0.8 - x - 0.8 * (x - x * x)) / kSlices;
  }
  // Pieces of a quarter's length lie up to 0.8/64 off the parabola, which is 0.62 long in x.
  EXPECT_NEAR(area(cut, cut.polygons[0]), expected, 0.62 * 0.8 / 64.0);
}

/// Triangles and quadrangles of tetrahedra at random lie in the plane of their corners' box and are
/// convex: their area is that of the section, found by adding up thin slices of the volume.
TEST(MeshCut, AreaIsTheDerivativeOfVolume) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    io::VolumeFrame mesh;
    for (int k = 0; k < 4; ++k)
      mesh.points.emplace_back(uniform(random), uniform(random), uniform(random));
    mesh.cells = {{0, 1, 2, 3}};
    const auto section = [&](double offset) {
      MeshCut cut;
      cut.offset = offset;
      cut.low = {-2.0, -2.0};
      cut.high = {2.0, 2.0};
      add_polygons(cut, mesh);
      return cut.polygons.empty() ? 0.0 : area(cut, cut.polygons[0]);
    };
    double volume = 0.0;
    constexpr int num_slices = 4000;
    for (int i = 0; i < num_slices; ++i)
      volume += section(-1.0 + (i + 0.5) * 2.0 / num_slices) * 2.0 / num_slices;
    const Vec3 a = mesh.points[1] - mesh.points[0], b = mesh.points[2] - mesh.points[0],
               c = mesh.points[3] - mesh.points[0];
    // The midpoint rule errs where the area has a kink: of the order of a slice.
    EXPECT_NEAR(volume, std::abs(a.cross(b).dot(c)) / 6.0, 2e-3) << "trial " << trial;
  }
}

TEST(MeshCut, GoesThroughTheDrop) {
  const test::TemporaryFolder folder;
  const io::VolumeFrame mesh = box_frame(folder);
  const MeshCut cut = cut_through_drops(mesh, 2);
  EXPECT_NEAR(cut.offset, 0.0, 1e-12);
  EXPECT_EQ(cut.axes, "xy");
  EXPECT_EQ(cut_through_drops(mesh, 1).axes, "xz");
  EXPECT_GT(cut.low[0], -4.0);  // the window is smaller than the box
  double inside = 0.0;
  for (const CutPolygon& polygon : cut.polygons) {
    EXPECT_TRUE(polygon.num_points == 3 || polygon.num_points == 4);
    if (polygon.region == 1) inside += area(cut, polygon);
  }
  EXPECT_NEAR(inside, M_PI, 0.25 * M_PI);  // cells of 0.67 R0 for a disc of radius 1
}

/// A linear function's mean over the corners is its value at their mean; a value by corner of cells
/// is that of the polygon's own cell, on either side of a jump.
TEST(MeshCut, PolygonsHaveTheValuesOfPoints) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(),
                            {.num_frames = 1, .num_volume_frames = 1, .has_scalars = true});
  const MeshCut cut = cut_through_drops(io::read_vtu(folder / "volume/volume-0000.vtu"), 2);
  ASSERT_EQ(cut.fields.size(), 2U);
  EXPECT_EQ(cut.fields[0].name, "temperature");  // 1 + 0.1 x
  EXPECT_EQ(cut.fields[1].name, "dye");          // 1 + the region
  ASSERT_EQ(cut.fields[0].values.size(), cut.polygons.size());
  ASSERT_EQ(cut.fields[1].values.size(), cut.polygons.size());
  for (std::size_t i = 0; i < cut.polygons.size(); ++i) {
    const CutPolygon& polygon = cut.polygons[i];
    double x = 0.0;
    for (int k = 0; k < polygon.num_points; ++k)
      x += cut.points[polygon.first_point + static_cast<std::size_t>(k)][0] / polygon.num_points;
    EXPECT_NEAR(cut.fields[0].values[i], 1.0 + 0.1 * x, 1e-14);  // roundoff of a few sums
    EXPECT_NEAR(cut.fields[1].values[i], 1.0 + polygon.region, 1e-14);
  }
}

TEST(MeshCut, RefusesWhatIsNoMesh) {
  const test::TemporaryFolder folder;
  put(folder / "torn.vtu", "torn");
  const std::string path = (folder / "torn.vtu").string();
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)io::read_vtu(path); }),
            path + ": not a volume mesh file of VTK (.vtu), or corrupt");
}

}  // namespace
}  // namespace meniscus::report
