#include "meniscus/surface/remesh.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/restore_volume.hpp"
#include "meniscus/surface/sizing.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

constexpr double kSphereArea = 4.0 * std::numbers::pi;

RemeshOptions with_nodes(int num_vertices) { return {.C0 = num_vertices / kSphereArea}; }

/// Remeshes a few times, as a surface that stands still is in a run, until nothing is edited.
RemeshReport settle(SurfaceMesh& mesh, const RemeshOptions& options) {
  RemeshReport report;
  for (int i = 0; i < 6; ++i) {
    report = remesh(mesh, options);
    EXPECT_TRUE(report.ok()) << report.text();
    if (report.splits + report.collapses + report.flips == 0) break;
  }
  return report;
}

struct LengthStatistics {
  double mean, deviation;
};
/// Mean and standard deviation of l/l0 over the edges.
LengthStatistics relative_lengths(const SurfaceMesh& mesh, const RemeshOptions& options) {
  const SurfaceTopology topology(mesh);
  const auto l0 = rest_lengths(mesh, topology, SmoothSurface(mesh, topology), options);
  double sum = 0.0, squares = 0.0;
  for (const SurfaceEdge& e : topology.edges()) {
    const double ratio = (mesh.x[e.a] - mesh.x[e.b]).norm() / (0.5 * (l0[e.a] + l0[e.b]));
    sum += ratio;
    squares += ratio * ratio;
  }
  const auto n = static_cast<double>(topology.edges().size());
  return {sum / n, std::sqrt(squares / n - sum / n * sum / n)};
}

/// Share of faces with an angle below the given one: what "bounded angles" means to a solver.
double share_of_faces_below(const SurfaceMesh& mesh, double degrees) {
  int below = 0;
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]],
                 b = mesh.x[v[(k + 2) % 3]] - mesh.x[v[k]];
      if (std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi < degrees) {
        ++below;
        break;
      }
    }
  return static_cast<double>(below) / mesh.num_faces();
}

TEST(Remesh, NumberOfVerticesFollowsTheCurvatureIntegral) {
  for (const int nodes : {110, 400, 1000})
    for (const double aspect : {1.0, 2.0, 4.0}) {
      SurfaceMesh mesh = stretched_sphere(nodes, Vec3(aspect, 1, 1));
      const RemeshOptions options = with_nodes(nodes);
      const RemeshReport report = settle(mesh, options);
      EXPECT_NEAR(mesh.num_vertices(), report.expected_vertices,
                  0.02 * report.expected_vertices + 1);
      // The shape itself asks for this many. At 110 nodes and aspect 4 the tip, an edge away from
      // which the curvature has halved, is not resolved.
      if (nodes == 110 && aspect == 4.0) continue;
      const double law = options.C0 * test::prolate_curvature_integral(aspect, 1.0);
      EXPECT_NEAR(mesh.num_vertices(), law, 0.05 * law) << nodes << " nodes, aspect " << aspect;
    }
}

TEST(Remesh, IsSoundOnRandomShapes) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    SurfaceMesh mesh = test::bumpy_sphere(600, seed, 0.6);
    const double volume = enclosed_volume(mesh);
    const RemeshReport first = remesh(mesh, with_nodes(400));
    ASSERT_TRUE(first.ok()) << first.text();
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_EQ(text_of(find_defect(mesh)), "");
    EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12 * volume);
    EXPECT_NEAR(mesh.num_vertices(), first.expected_vertices, 0.05 * first.expected_vertices);
    EXPECT_LT(share_of_faces_below(mesh, 20.0), 1e-3);
    EXPECT_GT(first.min_angle_deg, 5.0);
    EXPECT_DOUBLE_EQ(first.min_angle_deg, smallest_angle_deg(mesh));
  }
}

TEST(Remesh, KeepsATorusATorus) {
  SurfaceMesh mesh = test::torus(60, 24, 1.0, 0.4);
  const RemeshReport report = settle(mesh, {.C0 = 30.0});
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_EQ(text_of(find_defect(mesh)), "");
  EXPECT_GT(report.min_angle_deg, 20.0);
}

TEST(Remesh, ChangesVolumeLittleBeforeTheCorrection) {
  // A thousand nodes, the surface stretched by 1 % a step as in a run.
  SurfaceMesh mesh = sphere(1000);
  const RemeshOptions options = with_nodes(1000);
  for (int step = 0; step < 10; ++step) {
    for (Vec3& x : mesh.x) x = x.cwiseProduct(Vec3(1.02, 0.99, 0.99));
    const double volume = enclosed_volume(mesh);
    const RemeshReport report = remesh(mesh, options);
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_LT(std::abs(report.volume_change), 1e-4);
    EXPECT_LT(report.volume_shift_over_edge, 1e-3);
    EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-13 * volume);
  }
}

SurfaceMesh stretched(SurfaceMesh mesh, double factor) {
  for (Vec3& x : mesh.x)
    x = x.cwiseProduct(Vec3(factor, 1.0 / std::sqrt(factor), 1.0 / std::sqrt(factor)));
  return mesh;
}

TEST(Remesh, LeavesASurfaceThatIsFitUntilItIsStretched) {
  for (const double aspect : {1.0, 1.5, 3.0}) {
    const RemeshOptions options = with_nodes(200);
    SurfaceMesh mesh = stretched(sphere(200), aspect);
    EXPECT_TRUE(settle(mesh, options).ok());
    EXPECT_TRUE(is_fit(mesh, options)) << aspect;
    EXPECT_TRUE(is_fit(stretched(mesh, 1.03), options)) << aspect;
    EXPECT_FALSE(is_fit(stretched(mesh, 1.6), options)) << aspect;
  }
}

TEST(Remesh, CallsASurfaceUnfitThatHasTooManyVerticesOrIsNone) {
  const SurfaceMesh mesh = sphere(642);
  EXPECT_TRUE(is_fit(mesh, with_nodes(642)));
  EXPECT_FALSE(is_fit(mesh, with_nodes(580)));
  EXPECT_FALSE(is_fit(mesh, with_nodes(710)));
  const auto is_kept = [&](int nodes) {
    RemeshOptions options = with_nodes(nodes);
    options.kept = kKeptByCurvedElements;
    return is_fit(mesh, options);
  };
  EXPECT_TRUE(is_kept(585));
  EXPECT_TRUE(is_kept(700));
  EXPECT_FALSE(is_kept(570));
  EXPECT_FALSE(is_kept(715));
  SurfaceMesh open{mesh.x, {}};
  for (const FaceId f : ids<FaceId>(mesh.num_faces() - 1)) open.faces.add(mesh.faces[f]);
  EXPECT_FALSE(is_fit(open, with_nodes(642)));
  SurfaceMesh bad = mesh;
  bad.x[VertexId{0}].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_fit(bad, with_nodes(642)));
}

TEST(Remesh, ForgetsHistory) {
  // Stretched to aspect 3 and back in forty steps that keep the volume.
  SurfaceMesh mesh = sphere(1000);
  const RemeshOptions options = with_nodes(1000);
  EXPECT_TRUE(settle(mesh, options).ok());
  const auto journey = [&] {
    constexpr int kSteps = 20;
    const double factor = std::pow(3.0, 2.0 / 3.0 / kSteps);
    for (int step = 0; step < 2 * kSteps; ++step) {
      const double along = step < kSteps ? factor : 1.0 / factor;
      const double across = 1.0 / std::sqrt(along);
      for (Vec3& x : mesh.x) x = x.cwiseProduct(Vec3(along, across, across));
      const RemeshReport report = remesh(mesh, options);
      ASSERT_TRUE(report.ok()) << report.text();
    }
  };
  // The spiral that a sphere begins with has fewer vertices of valence 5 and 7 than any later mesh.
  journey();
  const int vertices_before = mesh.num_vertices();
  const LengthStatistics before = relative_lengths(mesh, options);
  journey();
  const LengthStatistics after = relative_lengths(mesh, options);
  EXPECT_NEAR(mesh.num_vertices(), vertices_before, 0.03 * vertices_before);
  EXPECT_NEAR(after.mean, before.mean, 0.03 * before.mean);
  EXPECT_NEAR(after.deviation, before.deviation, 0.1 * before.deviation);
}

struct EllipsoidErrors {
  double farthest = 0.0;   // of a vertex, over its rest length
  double curvature = 0.0;  // rms, relative
};
EllipsoidErrors ellipsoid_errors(const SurfaceMesh& mesh, const Vec3& axes,
                                 const RemeshOptions& options) {
  const SurfaceTopology topology(mesh);
  const auto fit = fitted_curvature(mesh, topology);
  const auto l0 = rest_lengths(mesh, topology, SmoothSurface(mesh, topology), options);
  EllipsoidErrors errors;
  for (const VertexId v : mesh.x.ids()) {
    const double distance = std::abs(test::ellipsoid_distance(mesh.x[v], axes));
    errors.farthest = std::max(errors.farthest, distance / l0[v]);
    const double exact = test::ellipsoid_curvature(mesh.x[v], axes).sum;
    errors.curvature += std::pow(fit[v].sum() / exact - 1.0, 2);
  }
  errors.curvature = std::sqrt(errors.curvature / mesh.num_vertices());
  return errors;
}

TEST(Remesh, ComesToRestOnAFixedShape) {
  const Vec3 axes(2, 1, 1);
  SurfaceMesh mesh = test::equilibrated_ellipsoid(500, axes);
  const RemeshOptions options = with_nodes(500);
  EXPECT_TRUE(settle(mesh, options).ok());
  const SurfaceMesh settled = mesh;
  for (int step = 0; step < 100; ++step) {
    const RemeshReport report = remesh(mesh, options);
    ASSERT_TRUE(report.ok()) << report.text();
  }
  double moved = 0.0;
  ASSERT_EQ(mesh.num_vertices(), settled.num_vertices());
  for (const VertexId v : mesh.x.ids()) moved = std::max(moved, (mesh.x[v] - settled.x[v]).norm());
  EXPECT_LT(moved, 0.02 * mean_edge(settled));  // the springs' own tolerance
}

TEST(Remesh, DoesNotWearTheShape) {
  // Every vertex circulates along the ellipsoid (a rotation of the sphere it is the image of), from
  // dense to sparse places and back: thousands of splits, collapses and flips, and every vertex
  // moved in every step. Nothing restores the shape, so that errors add up. An edge is 0.15 of the
  // unit: a third-order error would be of the order of 1e-2 of an edge at once.
  const Vec3 axes(2, 1, 1);
  SurfaceMesh mesh = test::equilibrated_ellipsoid(500, axes);
  const RemeshOptions options = with_nodes(500);
  EXPECT_TRUE(settle(mesh, options).ok());
  const EllipsoidErrors before = ellipsoid_errors(mesh, axes, options);
  const Mat3 turn = Eigen::AngleAxisd(0.02, Vec3::UnitZ()).toRotationMatrix();
  int edits = 0;
  for (int step = 0; step < 500; ++step) {
    for (Vec3& x : mesh.x) x = axes.cwiseProduct(turn * x.cwiseQuotient(axes));
    const double volume = enclosed_volume(mesh);
    const RemeshReport report = remesh(mesh, options);
    ASSERT_TRUE(report.ok()) << report.text();
    ASSERT_LT(std::abs(report.volume_change), 5e-4);
    // Vertices back to where remeshing alone had put them.
    restore_volume(mesh, volume * (1.0 + report.volume_change));
    edits += report.splits + report.collapses + report.flips;
  }
  EXPECT_GT(edits, 1000);
  const EllipsoidErrors after = ellipsoid_errors(mesh, axes, options);
  EXPECT_LT(after.farthest, 0.02);
  EXPECT_LT(after.curvature, before.curvature + 0.005);
  EXPECT_LT(share_of_faces_below(mesh, 20.0), 1e-3);
}

TEST(Remesh, TurnsWithTheSurface) {
  SurfaceMesh mesh = test::bumpy_sphere(400, 11, 0.5);
  SurfaceMesh turned = mesh;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  for (Vec3& x : turned.x) x = turn * x + Vec3(1, 2, 3);
  ASSERT_TRUE(remesh(mesh, with_nodes(300)).ok());
  ASSERT_TRUE(remesh(turned, with_nodes(300)).ok());
  ASSERT_EQ(mesh.faces, turned.faces);
  for (const VertexId v : mesh.x.ids())
    EXPECT_LT((turned.x[v] - (turn * mesh.x[v] + Vec3(1, 2, 3))).norm(), 1e-6);
}

TEST(Remesh, IsDeterministic) {
  SurfaceMesh a = test::bumpy_sphere(400, 5, 0.6), b = a;
  ASSERT_TRUE(remesh(a, with_nodes(700)).ok());
  ASSERT_TRUE(remesh(b, with_nodes(700)).ok());
  EXPECT_EQ(a, b);
}

TEST(Remesh, LeavesTheSurfaceAloneWhenItFails) {
  SurfaceMesh open = sphere(100);
  open.faces =
      FaceField<FaceVertices>(std::vector<FaceVertices>(open.faces.begin() + 1, open.faces.end()));
  SurfaceMesh inside_out = sphere(100);
  for (FaceVertices& f : inside_out.faces) std::swap(f[0], f[1]);
  SurfaceMesh broken = sphere(100);
  broken.x[VertexId{3}].x() = std::nan("");
  for (SurfaceMesh mesh : {open, inside_out}) {
    const SurfaceMesh before = mesh;
    const RemeshReport report = remesh(mesh, with_nodes(100));
    EXPECT_FALSE(report.ok());
    EXPECT_NE(report.text(), "");
    EXPECT_EQ(mesh, before);
  }
  EXPECT_FALSE(remesh(broken, with_nodes(100)).ok());

  SurfaceMesh refused = test::bumpy_sphere(300, 1, 0.5);
  const SurfaceMesh before = refused;
  RemeshOptions options = with_nodes(500);
  options.find_fault = [](const SurfaceMesh&) { return Fault{FaultKind::unwanted, "not wanted"}; };
  const RemeshReport report = remesh(refused, options);
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.text(), "not wanted");
  EXPECT_EQ(refused, before);
}

TEST(Remesh, SmallDropsKeepTheirLeastNumber) {
  SurfaceMesh mesh = sphere(200, 0.1);
  RemeshOptions options = with_nodes(12);
  options.min_vertices = 60;
  const RemeshReport report = settle(mesh, options);
  EXPECT_NEAR(mesh.num_vertices(), 60, 3);
  EXPECT_GT(report.min_angle_deg, 20.0);
}

TEST(RemeshOptions, NamesWhatIsWrong) {
  const auto message = [](auto change) {
    RemeshOptions options;
    change(options);
    try {
      options.validate();
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](RemeshOptions&) {}), "");
  EXPECT_EQ(message([](RemeshOptions& o) { o.C0 = -1; }), "remesh: C0 = -1 must be positive");
  EXPECT_EQ(message([](RemeshOptions& o) { o.volume = -2; }),
            "remesh: volume = -2 must be zero or positive");
  EXPECT_EQ(message([](RemeshOptions& o) { o.edge_floor = -0.5; }),
            "remesh: edge_floor = -0.5 must be zero or positive");
  EXPECT_EQ(message([](RemeshOptions& o) { o.edge_floor = 2, o.edge_ceiling = 1; }),
            "remesh: edge_ceiling = 1 must be larger than edge_floor");
  EXPECT_EQ(message([](RemeshOptions& o) { o.gradation = 0; }),
            "remesh: gradation = 0 must be positive");
  EXPECT_EQ(message([](RemeshOptions& o) { o.min_vertices = 3; }),
            "remesh: min_vertices = 3 must be at least 4");
  EXPECT_EQ(message([](RemeshOptions& o) { o.gap_layers = -1; }),
            "remesh: gap_layers = -1 must be between 0 and 100");
  EXPECT_EQ(message([](RemeshOptions& o) { o.max_sweeps = 0; }),
            "remesh: max_sweeps = 0 must be at least 1");
  EXPECT_EQ(message([](RemeshOptions& o) { o.spring_tolerance = 1; }),
            "remesh: spring_tolerance = 1 must be in [0, 1)");
}

/// Root of the mean squared distance of the vertices from the ellipsoid, after one remeshing of a
/// mesh whose vertices lie on it.
double distance_after_remeshing(int num_vertices, const Vec3& axes, bool on_splines) {
  SurfaceMesh mesh = stretched_sphere(num_vertices, axes);
  RemeshOptions options = with_nodes(num_vertices);
  options.restores_volume = false;
  options.on_splines = on_splines;
  const RemeshReport report = remesh(mesh, options);
  EXPECT_TRUE(report.ok()) << report.text();
  double squares = 0.0;
  for (const Vec3& x : mesh.x) squares += std::pow(test::ellipsoid_distance(x, axes), 2);
  return std::sqrt(squares / mesh.num_vertices());
}

/// Errors on splines over those on patches, and the order in the edge from the first to the last.
void expect_closer(const Vec3& axes, const std::vector<int>& sizes, double most, double order) {
  std::vector<double> errors;
  for (const int num_vertices : sizes) {
    errors.push_back(distance_after_remeshing(num_vertices, axes, true));
    EXPECT_LT(errors.back(), most * distance_after_remeshing(num_vertices, axes, false))
        << num_vertices;
  }
  const double edges = std::sqrt(double(sizes.back()) / sizes.front());
  EXPECT_GT(std::log(errors.front() / errors.back()) / std::log(edges), order);
}

// Measured: 0.34 to 0.05 of the patches' errors on the spheroid, 0.57 and 0.32 on the ellipsoid,
// and orders of 5.2 and 5.4.
TEST(Remesh, OnSplinesLeavesVerticesCloserToTheSurface) {
  expect_closer(Vec3(1.4, 0.85, 0.85), {110, 220, 440, 880}, 0.5, 4.8);
  expect_closer(Vec3(1.6, 1.0, 0.6), {440, 880}, 0.7, 4.8);
}

TEST(RestoreVolume, ReachesTheVolumeAlongAreaVectors) {
  SurfaceMesh mesh = test::bumpy_sphere(500, 2, 0.5);
  const double volume = enclosed_volume(mesh);
  for (const double factor : {1.3, 1.0 + 1e-6, 0.8}) {
    SurfaceMesh shifted = mesh;
    const double shift = restore_volume(shifted, factor * volume);
    EXPECT_NEAR(enclosed_volume(shifted), factor * volume, 1e-13 * factor * volume);
    EXPECT_EQ(shift > 0.0, factor > 1.0);
    const auto area = vertex_area_vectors(mesh);
    for (const VertexId v : mesh.x.ids())
      EXPECT_LT((shifted.x[v] - mesh.x[v] - shift * area[v].normalized()).norm(), 1e-12);
  }
  SurfaceMesh same = mesh;
  EXPECT_NEAR(restore_volume(same, volume), 0.0, 1e-14);
}

}  // namespace
}  // namespace meniscus
