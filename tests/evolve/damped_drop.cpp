#include "tests/evolve/damped_drop.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus::test {
namespace {

constexpr double kWallRadius = 4.0;

SurfaceShape shape_of(fem::Elements elements) {
  return elements == fem::Elements::p2_p1 ? SurfaceShape::splined : SurfaceShape::faceted;
}

SurfaceMesh surface_of(const DampedDrop& drop) {
  SurfaceMesh mesh = sphere(drop.num_vertices);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const double longest = std::pow((1.0 + drop.D) / (1.0 - drop.D), 2.0 / 3.0);
  for (Vec3& x : mesh.x) {
    const Vec3 radial = x.normalized();
    x *= 1.0 + drop.l4 * std::legendre(4, radial.x());
    x = x.cwiseProduct(Vec3(longest, 1.0 / std::sqrt(longest), 1.0 / std::sqrt(longest)));
    x += drop.center + drop.noise * normal(random) * radial;
  }
  return mesh;
}

Scene scene_of(const DampedDrop& drop) {
  Scene scene;
  scene.Ca = drop.Ca;
  scene.liquids = Field<RegionId, Liquid>(2, Liquid{});
  scene.liquids[RegionId{1}].viscosity = drop.viscosity_ratio;
  Interface interface;
  interface.mesh = surface_of(drop);
  interface.inside = RegionId{1};
  interface.outside = RegionId{0};
  interface.tension = 1.0 / drop.Ca;
  interface.C0 = drop.num_vertices / (4.0 * std::numbers::pi);
  interface.volume = interface.initial_volume =
      ReconstructedSurface(interface.mesh, shape_of(drop.elements)).volume();
  if (drop.surfactant) {
    interface.surfactant = drop.surfactant;
    interface.fields.on_vertices.push_back(
        {.name = kSurfactantField,
         .unit = "",
         .transfer = FieldTransfer::conserved,
         .values = VertexField<double>(interface.mesh.num_vertices(), 1.0)});
  }
  scene.interfaces.push_back(std::move(interface));
  scene.boundary.mesh = sphere(drop.num_vertices, kWallRadius);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  const auto velocity = [gradient = drop.gradient, wind = drop.wind](const Vec3& x, double) {
    return Vec3(gradient * x + wind);
  };
  scene.boundary.patches.add({"wall", ImposedVelocity{velocity, true},
                              [](const Vec3& x) { return Vec3(kWallRadius * x.normalized()); }});
  return scene;
}

/// The orders that a measure at t = 0.5 shows by the differences of runs whose steps are halved.
template <class Measure>
std::array<double, 2> orders(const DampedDrop& drop, double dt, Measure&& measure) {
  std::array<double, 4> values{};
  for (double& value : values) {
    Evolution evolution = evolution_of(drop, dt);
    run(evolution, 0.5);
    value = measure(evolution);
    dt *= 0.5;
  }
  const auto order = [&](std::size_t k) {
    return std::log2(std::abs((values[k] - values[k + 1]) / (values[k + 1] - values[k + 2])));
  };
  return {order(0), order(1)};
}

}  // namespace

double capillary_time(const DampedDrop& drop) { return drop.Ca * shortest_edge(surface_of(drop)); }

Evolution evolution_of(const DampedDrop& drop, double dt) {
  const bool is_quadratic = drop.elements == fem::Elements::p2_p1;
  fem::Options options;
  options.elements = drop.elements;
  options.capillary = drop.form;
  options.rtol = drop.rtol;
  EvolutionOptions evolution;
  evolution.scheme = drop.scheme;
  evolution.surface = shape_of(drop.elements);
  evolution.motion_normal = is_quadratic ? MotionNormal::faces : MotionNormal::area_vector;
  evolution.step_factor = 1e9;  // the bounds decide
  evolution.tolerance = std::numeric_limits<double>::infinity();
  evolution.max_step = dt;
  evolution.min_step = 0.999 * dt;
  evolution.remesh_every = 1000000;
  MovingMesh mesh({fem::suited_volume_mesh(drop.elements), VolumeMotion::harmonic});
  Scene scene = scene_of(drop);
  const MeshChange made = mesh.follow(scene);
  EXPECT_TRUE(made.ok()) << made.text();
  return {std::move(scene), evolution, fem::make_finite_element_flow(options), std::move(mesh)};
}

void run(Evolution& evolution, double end) {
  while (evolution.t() < end - 1e-9) {
    const Report solved = evolution.solve();
    ASSERT_TRUE(solved.ok()) << solved.text();
    const Report advanced = evolution.advance();
    ASSERT_TRUE(advanced.ok()) << advanced.text();
  }
}

double area_in(const Evolution& evolution, fem::Elements elements) {
  return ReconstructedSurface(evolution.scene().interfaces[0].mesh, shape_of(elements)).area();
}

Vec3 centroid_in(const Evolution& evolution) {
  return enclosed_centroid(evolution.scene().interfaces[0].mesh);
}

double angle_in(const Evolution& evolution) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(
      enclosed_second_moments(evolution.scene().interfaces[0].mesh));
  const Vec3 longest = axes.eigenvectors().col(2);
  return std::atan(longest.y() / longest.x());
}

Mat3 simple_shear() {
  Mat3 gradient = Mat3::Zero();
  gradient(0, 1) = 1.0;
  return gradient;
}

std::array<double, 2> orders_in_relaxation(fem::Elements elements) {
  return orders({.elements = elements, .Ca = 0.5, .D = 0.0, .l4 = 0.1, .rtol = 1e-9}, 0.05,
                [&](const Evolution& evolution) { return area_in(evolution, elements); });
}

std::array<double, 2> orders_in_shear(fem::Elements elements) {
  return orders(
      {.elements = elements, .Ca = 1.0, .D = 0.15, .gradient = simple_shear(), .rtol = 1e-9}, 0.125,
      [&](const Evolution& evolution) { return area_in(evolution, elements); });
}

std::array<double, 2> orders_beside_midpoint(fem::Elements elements) {
  std::array<double, 3> differences{};
  double dt = 0.25;
  for (double& difference : differences) {
    DampedDrop drop{
        .elements = elements, .Ca = 0.5, .D = 0.15, .gradient = simple_shear(), .rtol = 1e-9};
    Evolution damped = evolution_of(drop, dt);
    run(damped, 0.5);
    drop.scheme = TimeScheme::rk2;
    Evolution midpoint = evolution_of(drop, dt);
    run(midpoint, 0.5);
    difference = std::abs(angle_in(damped) - angle_in(midpoint));
    dt *= 0.5;
  }
  return {std::log2(differences[0] / differences[1]), std::log2(differences[1] / differences[2])};
}

std::vector<double> excesses(const DampedDrop& drop, int num_steps) {
  const double dt = 27.5 * (1.0 + drop.viscosity_ratio) * capillary_time(drop);
  Evolution evolution = evolution_of(drop, dt);
  std::vector<double> areas = {area_in(evolution, drop.elements)};
  for (int step = 1; step <= num_steps; ++step) {
    run(evolution, step * dt);
    areas.push_back(area_in(evolution, drop.elements));
  }
  std::vector<double> result;
  for (const double area : areas)
    result.push_back((area - areas.back()) / (areas.front() - areas.back()));
  return result;
}

}  // namespace meniscus::test
