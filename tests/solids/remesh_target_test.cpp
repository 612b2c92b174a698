#include "meniscus/solids/remesh_target.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/mesh/surface_quality.hpp"
#include "meniscus/solids/solid_check.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

using By = RemeshTarget::By;

TEST(RemeshTarget, MeetsTheNumberOfNodesOnEveryShapeAndScale) {
  for (const double scale : {1e-6, 1.0, 3e4})
    for (SurfaceMesh mesh : {stretched_sphere(600, Vec3(3, 1, 1)), test::torus(40, 16, 1.0, 0.4),
                             test::bumpy_sphere(600, 3, 0.4)}) {
      for (Vec3& x : mesh.x) x = scale * (x + Vec3(7, 0, -3));
      const double volume = enclosed_volume(mesh);
      const TargetReport report = remesh_to(mesh, {.by = By::nodes, .value = 800});
      ASSERT_TRUE(report.ok()) << report.text();
      EXPECT_TRUE(report.is_met);
      EXPECT_NEAR(mesh.num_vertices(), 800, 16);  // the band of 2 %
      EXPECT_EQ(report.reached, mesh.num_vertices());
      EXPECT_NEAR(enclosed_volume(mesh) / volume, 1.0, 1e-10);
    }
}

TEST(RemeshTarget, MeetsTheMeanEdge) {
  for (const double edge : {0.08, 0.15, 0.3}) {
    SurfaceMesh mesh = stretched_sphere(600, Vec3(2, 1, 1));
    const TargetReport report = remesh_to(mesh, {.by = By::edge_length, .value = edge});
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_NEAR(mean_edge(mesh), edge, 0.01 * edge);
    const SurfaceQuality q = surface_quality(mesh, SurfaceTopology(mesh));
    EXPECT_GT(q.min_edge, 0.5 * edge);
    EXPECT_LT(q.max_edge, 1.6 * edge);  // what the remesher splits
  }
}

TEST(RemeshTarget, KeepsTheChordalErrorToTheTrueSurface) {
  // Against the torus itself: what the faces are off by is at most what was asked for, plus what
  // the smooth surface of the given mesh is off by (of order h⁴: 2e-4 as `smooth_surface_test` has
  // it).
  const double major = 1.0, minor = 0.4;
  std::vector<double> errors, vertices;
  for (const double error : {0.02, 0.01, 0.005}) {
    SurfaceMesh mesh = test::torus(80, 32, major, minor);
    const TargetReport report = remesh_to(mesh, {.by = By::chordal_error, .value = error});
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_TRUE(report.is_met);
    double largest = 0.0;
    constexpr int kCuts = 6;
    for (const FaceVertices& v : mesh.faces)
      for (int i = 0; i <= kCuts; ++i)
        for (int j = 0; j <= kCuts - i; ++j) {
          const Vec3 x =
              (i * mesh.x[v[0]] + j * mesh.x[v[1]] + (kCuts - i - j) * mesh.x[v[2]]) / kCuts;
          const double d = std::hypot(std::hypot(x.x(), x.y()) - major, x.z()) - minor;
          largest = std::max(largest, std::abs(d));
        }
    EXPECT_LT(largest, error + 2e-4);
    EXPECT_GT(largest, 0.6 * error);  // nor is it far finer than it need be
    vertices.push_back(mesh.num_vertices());
    errors.push_back(largest);
  }
  EXPECT_NEAR(test::observed_order(vertices, errors), 2.0, 0.2);  // e ∝ l²
}

TEST(RemeshTarget, RemeshesEveryPieceAndTurnsCavitiesBack) {
  SurfaceMesh cavity = sphere(200, 0.5);
  turn_inside_out(cavity);
  SurfaceMesh mesh =
      joined_surface(std::array{sphere(400), cavity, sphere(300, 0.3, Vec3(4, 0, 0))});
  const double volume = enclosed_volume(mesh);
  const TargetReport report = remesh_to(mesh, {.by = By::nodes, .value = 600});
  ASSERT_TRUE(report.ok()) << report.text();
  EXPECT_EQ(text_of(find_solid_defect(mesh)), "");
  const std::vector<SurfaceMesh> pieces = connected_pieces(mesh);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_LT(enclosed_volume(pieces[1]), 0.0);
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-10);
  for (const SurfaceMesh& piece : pieces)  // spheres of any size get as many
    EXPECT_NEAR(piece.num_vertices(), 200, 20);
}

TEST(RemeshTarget, RoundsCreasesAndSaysSo) {
  SurfaceMesh mesh = box(8, Vec3(1, 1, 2)).mesh;
  const double volume = enclosed_volume(mesh);
  const TargetReport report = remesh_to(mesh, {.by = By::edge_length, .value = 0.25});
  ASSERT_TRUE(report.ok()) << report.text();
  EXPECT_TRUE(report.are_creases_rounded);
  EXPECT_EQ(text_of(find_solid_defect(mesh)), "");
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-10);
  EXPECT_NEAR(mean_edge(mesh), 0.25, 0.0025);
  EXPECT_LT(mesh.x[VertexId{0}].cwiseAbs().maxCoeff(), 2.1);
}

TEST(RemeshTarget, TakesSliversWithoutCreasesForASmoothSurface) {
  // Rows far apart make slivers of 1:8, and normals turn by 30° from row to row.
  const double major = 2.0, minor = 1.0;
  for (const auto& [by, value] : {std::pair(By::chordal_error, 0.004), std::pair(By::nodes, 900.0),
                                  std::pair(By::edge_length, 0.25)}) {
    SurfaceMesh mesh = test::torus(96, 12, major, minor);
    ASSERT_LT(surface_quality(mesh, SurfaceTopology(mesh)).low_angle_deg, 10.0);
    const TargetReport report = remesh_to(mesh, {.by = by, .value = value});
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_TRUE(report.is_met);
    EXPECT_FALSE(report.are_creases_rounded);
    EXPECT_GT(surface_quality(mesh, SurfaceTopology(mesh)).low_angle_deg, 40.0);
    // The flat faces that came lie up to 1 − cos 15° = 0.034 inside the torus.
    for (const Vec3& x : mesh.x)
      EXPECT_NEAR(std::hypot(std::hypot(x.x(), x.y()) - major, x.z()), minor, 0.034);
    if (by != By::chordal_error) continue;
    for (const FaceVertices& v : mesh.faces) {
      const Vec3 x = (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
      EXPECT_NEAR(std::hypot(std::hypot(x.x(), x.y()) - major, x.z()), minor, value);
    }
  }
}

TEST(RemeshTarget, RejectsWhatCannotBeMeant) {
  SurfaceMesh mesh = sphere(60);
  const SurfaceMesh before = mesh;
  for (const RemeshTarget& target :
       {RemeshTarget{.by = By::nodes, .value = 11}, RemeshTarget{.by = By::nodes, .value = NAN},
        RemeshTarget{.by = By::edge_length, .value = 0.0},
        RemeshTarget{.by = By::edge_length, .value = 1e-5},
        RemeshTarget{.by = By::chordal_error, .value = 1e-9},
        RemeshTarget{.by = By::nodes, .value = 100, .gradation = 0.0},
        RemeshTarget{.by = By::edge_length, .value = 0.1, .edge_floor = 0.1}})
    EXPECT_THROW((void)remesh_to(mesh, target), InvalidInput);
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace meniscus
