#include "meniscus/evolve/wave_damping.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/evolve/constants.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::test {
namespace {

constexpr double kRadius = 0.5, kTension = 3.0;
const std::vector<double> kViscosities = {1.0, 1.0};

Scene sphere_in_matrix(int num_vertices) {
  Scene scene;
  scene.liquids = Field<RegionId, Liquid>(2, Liquid{});
  Interface interface;
  interface.mesh = sphere(num_vertices, kRadius);
  interface.inside = RegionId{1};
  interface.outside = RegionId{0};
  interface.tension = kTension;
  interface.volume = enclosed_volume(interface.mesh);
  scene.interfaces.push_back(std::move(interface));
  return scene;
}

/// The factor by which damping multiplies the mode P_l(x/r).
double factor_of_mode(int l, double viscosity_ratio, double duration, int num_vertices) {
  const Scene scene = sphere_in_matrix(num_vertices);
  const SurfaceMesh& mesh = scene.interfaces[0].mesh;
  NormalSpeeds speeds(1, VertexField<double>(mesh.num_vertices()));
  for (const VertexId v : mesh.x.ids())
    speeds[0][v] = std::legendre(static_cast<unsigned>(l), mesh.x[v].x() / kRadius);
  const NormalSpeeds none(1, VertexField<double>(mesh.num_vertices(), 0.0));
  const NormalSpeeds damped =
      damped_speeds(scene, std::vector{1.0, viscosity_ratio}, speeds, none, {duration});
  double product = 0.0, square = 0.0;
  for (const VertexId v : mesh.x.ids()) {
    product += damped[0][v] * speeds[0][v];
    square += speeds[0][v] * speeds[0][v];
  }
  return product / square;
}

// Neither is a sum that ends by itself.
TEST(WaveDamping, EndsWhereNumbersOverflow) {
  Scene scene = sphere_in_matrix(60);
  const std::int32_t count = scene.interfaces[0].mesh.num_vertices();
  const NormalSpeeds speeds(1, VertexField<double>(count, 1.0)),
      none(1, VertexField<double>(count, 0.0));
  scene.interfaces[0].tension = 1e-300;
  EXPECT_EQ(damped_speeds(scene, kViscosities, speeds, none, {1.0}), speeds);
  scene.interfaces[0].tension = 1e300;
  const NormalSpeeds damped = damped_speeds(scene, kViscosities, speeds, none, {1.0});
  EXPECT_FALSE(std::abs(damped[0][VertexId{0}]) > 1e-6);
}

// On a sphere −Δ_s has the eigenvalues l(l + 1)/R².
TEST(WaveDamping, DampsTheModesOfASphereByTheirWaveNumbers) {
  for (const int l : {2, 4, 8})
    for (const double lambda : {0.01, 1.0, 100.0})
      for (const double z : {0.01, 1.0, 100.0}) {
        const double unit = kTension / (2.0 * (1.0 + lambda) * kRadius);
        const double q = z * std::sqrt(l * (l + 1.0) + kSphereStiffness);
        const double exact = 1.0 / (1.0 + q * q / (q + kUndampedShare));
        EXPECT_NEAR(factor_of_mode(l, lambda, z / unit, 2562) / exact, 1.0, 0.03)
            << l << " " << lambda << " " << z;
      }
}

// The rate of the volume is Σ ∂V/∂x_v · n_v s_v.
TEST(WaveDamping, KeepsTheRateOfTheVolume) {
  const Scene scene = sphere_in_matrix(110);
  const VertexField<Vec3> area = vertex_area_vectors(scene.interfaces[0].mesh);
  NormalSpeeds speeds(1, VertexField<double>(area.size()));
  const NormalSpeeds none(1, VertexField<double>(area.size(), 0.0));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  double rate = 0.0, total = 0.0;
  for (const VertexId v : area.ids()) {
    speeds[0][v] = normal(random);
    rate += area[v].norm() * speeds[0][v];
    total += area[v].norm();
  }
  for (double& s : speeds[0]) s -= rate / total;
  const NormalSpeeds damped = damped_speeds(scene, kViscosities, speeds, none, {0.3});
  double left = 0.0;
  for (const VertexId v : area.ids()) left += area[v].norm() * damped[0][v];
  EXPECT_NEAR(left, 0.0, 1e-12 * total);
}

TEST(WaveDamping, LeavesWhatItIsAbout) {
  const Scene scene = sphere_in_matrix(110);
  NormalSpeeds speeds(1);
  for (const Vec3& x : scene.interfaces[0].mesh.x) speeds[0].add(x.x());
  EXPECT_EQ(damped_speeds(scene, kViscosities, speeds, speeds, {10.0}), speeds);
}

}  // namespace
}  // namespace meniscus::test
