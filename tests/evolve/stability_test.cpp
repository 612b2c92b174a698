// The fastest capillary wave of a triangulation, and what steps do to it.
#include "meniscus/evolve/stability.hpp"

#include <cmath>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

/// The largest decay rate of a normal displacement of the vertices: power iteration on
/// −∂(n·u)/∂x.
double fastest_rate(const Case& c) {
  Scene scene = build_scene(c);
  EvolutionOptions options = c.evolution;
  Evolution evolution(scene, options, make_flow_solver(c));
  EXPECT_TRUE(evolution.prepare().ok());
  scene = evolution.scene();
  const SurfaceMesh mesh = scene.interfaces[0].mesh;
  VertexField<Vec3> n = vertex_area_vectors(mesh);
  for (Vec3& each : n) each.normalize();
  const auto solver = make_flow_solver(c);
  const auto normal_velocity = [&](const VertexField<double>& wave, double height) {
    for (const VertexId v : n.ids())
      scene.interfaces[0].mesh.x[v] = mesh.x[v] + height * wave[v] * n[v];
    const FlowSolution flow = solver->solve({scene}, {});
    EXPECT_TRUE(flow.ok());
    VertexField<double> u(n.size());
    for (const VertexId v : n.ids()) u[v] = n[v].dot(flow.velocity[0][v]);
    return u;
  };
  VertexField<double> wave(n.size());
  std::mt19937 random(7);
  for (double& each : wave) each = std::normal_distribution<double>()(random);
  double rate = 0.0;
  for (int k = 0; k < 30; ++k) {
    double norm = 0.0;
    for (const double each : wave) norm = std::max(norm, std::abs(each));
    for (double& each : wave) each /= norm;
    const double height = 1e-5;
    const VertexField<double> up = normal_velocity(wave, height),
                              down = normal_velocity(wave, -height);
    double product = 0.0, square = 0.0;
    for (const VertexId v : n.ids()) {
      const double change = (up[v] - down[v]) / (2.0 * height);
      product += change * wave[v];
      square += wave[v] * wave[v];
      wave[v] = change;
    }
    rate = -product / square;
  }
  return rate;
}

// k ≤ √6/h is that of a plane triangulated evenly: meshes of a drop show no shorter waves, and the
// bound is no more than twice what they show.
TEST(Stability, CapillaryRateBoundsTheFastestWave) {
  for (const auto& [lambda, shape, nodes] :
       {std::tuple(0.1, "axes = [1.6, 0.8, 0.8]", 110), std::tuple(10.0, "radius = 1.0", 110),
        std::tuple(1.0, "radius = 1.0", 200)}) {
    const Case c = test::unbounded_case({.shape = shape, .lambda = lambda, .nodes = nodes});
    Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c));
    ASSERT_TRUE(evolution.prepare().ok());
    const double fastest = fastest_rate(c), bound = capillary_rate(evolution.scene());
    EXPECT_LT(fastest, bound) << shape;
    EXPECT_GT(fastest, 0.5 * bound) << shape;
  }
}

TEST(Stability, RateIsThatOfTheStiffestInterface) {
  const Case c = test::unbounded_case({.shape = "radius = 1.0", .lambda = 3.0});
  Scene scene = build_scene(c);
  const double rate = capillary_rate(scene);
  Interface other = scene.interfaces[0];
  other.tension *= 4.0;
  other.inside = scene.liquids.add({.viscosity = 7.0});
  scene.interfaces.push_back(other);
  EXPECT_NEAR(capillary_rate(scene), 2.0 * rate, 1e-12 * rate);  // 4 · (1 + 3)/(1 + 7)
  EXPECT_NEAR(longest_stable_step(scene, TimeScheme::rk2), 1.0 / rate, 1e-12 / rate);
  EXPECT_GT(longest_stable_step(scene, TimeScheme::rkc), 100.0 / rate);
  for (Interface& each : scene.interfaces) each.tension = 0.0;
  EXPECT_TRUE(std::isinf(longest_stable_step(scene, TimeScheme::rk2)));
}

TEST(Stability, SpectrumHasWhatTheLiquidCarriesPastTheVertices) {
  const Case c = test::unbounded_case({.shape = "radius = 1.0", .lambda = 3.0});
  const Scene scene = build_scene(c);
  const std::int32_t count = scene.interfaces[0].mesh.num_vertices();
  const InterfaceMotion rest{VertexField<Vec3>(count, Vec3::Zero())};
  InterfaceMotion velocity = rest;
  velocity[0][VertexId{7}] = Vec3(0.0, 0.3, 0.4);
  const double dt = 0.1, rate = capillary_rate(scene);
  const WaveSpectrum waves = wave_spectrum(scene, rest, velocity, dt);
  EXPECT_NEAR(waves.decay, rate * dt, 1e-12);
  EXPECT_NEAR(waves.ratio, 2.0 * (1.0 + 3.0) * 0.5 / scene.interfaces[0].tension, 1e-12);
  const double h = mean_edges(scene.interfaces[0].mesh)[VertexId{7}];
  EXPECT_NEAR(waves.convection, std::sqrt(6.0) * 0.5 * dt / h, 1e-12);
  // A vertex that goes along sees no waves pass.
  EXPECT_EQ(wave_spectrum(scene, velocity, velocity, dt).convection, 0.0);
  Scene slack = scene;
  slack.interfaces[0].tension = 0.0;
  const WaveSpectrum none = wave_spectrum(slack, rest, velocity, dt);
  EXPECT_EQ(none.decay + none.ratio + none.convection, 0.0);
  EXPECT_EQ(ChebyshevScheme::for_waves(none, kMostStages).stages().size(), 3U);
}

/// Excess of a drop's area over that of the sphere it ends as, at steps of ten times the midpoint
/// rule's longest: an ellipsoid of D = 0.005 with noise of a tenth of that, never remeshed. A
/// longer drop would not be followed by steps of this length.
std::vector<double> excess_areas(TimeScheme scheme, double lambda) {
  const Case c = test::unbounded_case({.shape = "axes = [1.01, 0.995, 0.995]", .lambda = lambda});
  Scene scene = build_scene(c);
  std::mt19937 random(3);
  for (Vec3& x : scene.interfaces[0].mesh.x)
    x *= 1.0 + 5e-4 * std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  const double dt = 10.0 * longest_stable_step(scene, TimeScheme::rk2);
  std::vector<double> areas;
  const Report report = test::run(
      c, scene,
      [&](EvolutionOptions& options) {
        options.scheme = scheme;
        options.max_step = dt;
        options.min_step = 0.9 * dt;  // no second attempt
        options.step_factor = 1e3;
        options.end = 12.0 * dt;
        options.remesh_every = 1000000;
      },
      [&](const Evolution& evolution) {
        areas.push_back(surface_area(evolution.scene().interfaces[0].mesh));
      });
  EXPECT_EQ(report.ok(), scheme == TimeScheme::rkc) << report.text();
  for (double& area : areas) area -= areas.back();
  return areas;
}

TEST(Stability, ChebyshevStepsSmoothNoiseAtTenTimesTheMidpointsLimit) {
  for (const double lambda : {0.1, 10.0}) {
    const std::vector<double> excess = excess_areas(TimeScheme::rkc, lambda);
    for (std::size_t k = 1; k < excess.size() && excess[k - 1] > 1e-3 * excess[0]; ++k)
      EXPECT_LT(excess[k], excess[k - 1]) << lambda << ' ' << k;
    ASSERT_GT(excess.size(), 12u);
    EXPECT_LT(excess[6], 0.61 * excess[0]);  // |P| ≤ 0.96 in every step, squared
  }
}

TEST(Stability, MidpointStepsOfThatLengthAreRefused) {
  EXPECT_EQ(excess_areas(TimeScheme::rk2, 1.0).size(), 1u);
}

}  // namespace
}  // namespace meniscus
