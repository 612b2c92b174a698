#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/sizing.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

constexpr double kSphereArea = 4.0 * std::numbers::pi;

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

struct Journey {
  double worst_law = 0.0;  // largest |N_S/(C0 ∮⟨κ⟩² dS) − 1|
  double volume_change = 0.0, shift_over_edge = 0.0;
};
/// A sphere, remeshed after each of `steps` exact affine maps that carry the prolate spheroid of
/// aspect `from` to that of aspect `to`, the volume kept.
Journey stretch(SurfaceMesh& mesh, double from, double to, int steps,
                const RemeshOptions& options) {
  Journey journey;
  const double factor = std::pow(to / from, 2.0 / 3.0 / steps);
  for (int step = 1; step <= steps; ++step) {
    for (Vec3& x : mesh.x)
      x = x.cwiseProduct(Vec3(factor, 1 / std::sqrt(factor), 1 / std::sqrt(factor)));
    const RemeshReport report = remesh(mesh, options);
    EXPECT_TRUE(report.ok()) << report.text();
    const double aspect = from * std::pow(to / from, static_cast<double>(step) / steps);
    const double law = options.C0 * test::prolate_curvature_integral(aspect, 1.0);
    journey.worst_law = std::max(journey.worst_law, std::abs(mesh.num_vertices() / law - 1.0));
    journey.volume_change = std::max(journey.volume_change, std::abs(report.volume_change));
    journey.shift_over_edge = std::max(journey.shift_over_edge, report.volume_shift_over_edge);
  }
  return journey;
}

/// A sphere whose vertices have been strewn at random, at rest again. (The points on a spiral that
/// `sphere` gives have far fewer vertices of valence 5 and 7 than any surface that has flowed.)
SurfaceMesh strewn_sphere(int num_vertices, const RemeshOptions& options) {
  SurfaceMesh mesh = sphere(num_vertices);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const double edge = length_of_density(num_vertices / kSphereArea);
  for (Vec3& x : mesh.x) {
    x += edge * Vec3(uniform(random), uniform(random), uniform(random));
    x.normalize();
  }
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(remesh(mesh, options).ok());
  return mesh;
}

TEST(History, ThereAndBackIsAsBefore) {
  // To aspect 6 and back in a hundred remeshed steps of 2.4 %.
  const RemeshOptions options{.C0 = 2000 / kSphereArea};
  SurfaceMesh mesh = strewn_sphere(2000, options);
  const int vertices = mesh.num_vertices();
  const LengthStatistics before = relative_lengths(mesh, options);
  const Journey there = stretch(mesh, 1.0, 6.0, 50, options);
  const Journey back = stretch(mesh, 6.0, 1.0, 50, options);
  const LengthStatistics after = relative_lengths(mesh, options);
  EXPECT_NEAR(mesh.num_vertices(), vertices, 0.03 * vertices);
  EXPECT_NEAR(after.mean, before.mean, 0.03 * before.mean);
  EXPECT_NEAR(after.deviation, before.deviation, 0.03 * before.deviation);
  RecordProperty("vertices", fmt::format("{} {}", vertices, mesh.num_vertices()));
  RecordProperty("mean", fmt::format("{:.4f} {:.4f}", before.mean, after.mean));
  RecordProperty("deviation", fmt::format("{:.4f} {:.4f}", before.deviation, after.deviation));
  for (const Journey& journey : {there, back}) {
    EXPECT_LT(journey.worst_law, 0.01);
    EXPECT_LT(journey.shift_over_edge, 1e-3);
    // On the way back up to 80 vertices of 4000 go in a step: what the faces lie lower than the
    // surface, 5.4/N of the volume of a sphere, is lost faster than in ordinary steps.
    EXPECT_LT(journey.volume_change, 1e-4);
  }
}

TEST(History, CoarseEllipsoidsFollowTheLaw) {
  // Stretched step by step as in a run: a coarse sphere stretched at once does not show its tips.
  for (const int nodes : {110, 200, 400})
    for (const double aspect : {4.0, 6.0}) {
      SurfaceMesh mesh = sphere(nodes);
      const Journey journey = stretch(mesh, 1.0, aspect, 40, {.C0 = nodes / kSphereArea});
      EXPECT_LT(journey.worst_law, 0.05) << nodes << " nodes, aspect " << aspect;
    }
}

}  // namespace
}  // namespace meniscus
