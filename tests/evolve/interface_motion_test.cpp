#include "meniscus/evolve/interface_motion.hpp"

#include <random>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

Scene one_interface(SurfaceMesh mesh, double tension) {
  Scene scene;
  Interface interface;
  interface.mesh = std::move(mesh);
  interface.tension = tension;
  scene.interfaces.push_back(std::move(interface));
  return scene;
}

TEST(InterfaceMotion, AreaVectorNormalsKeepTheVolumesRate) {
  // Any velocity with Σ A_i·v_i = 0 (what the discrete continuity equation gives) moved along its
  // own area-vector normals leaves dV/dt = Σ A_i·ẋ_i unchanged.
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Scene scene = one_interface(stretched_sphere(200, Vec3(1.5, 0.7, 1.0)), 1.0);
  const SurfaceMesh& mesh = scene.interfaces[0].mesh;
  std::vector<VertexField<Vec3>> v{VertexField<Vec3>(mesh.num_vertices())};
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  for (Vec3& each : v[0]) each = Vec3(normal(random), normal(random), normal(random));
  const auto volume_rate = [&](const VertexField<Vec3>& w) {
    double rate = 0.0;
    for (const VertexId i : w.ids()) rate += area[i].dot(w[i]);
    return rate;
  };
  const InterfaceMotion motion = normal_motion(scene, v, MotionNormal::area_vector);
  EXPECT_NEAR(volume_rate(motion[0]), volume_rate(v[0]), 1e-12);
}

TEST(InterfaceMotion, RigidTranslationOfASphereIsItsNormalPart) {
  Scene scene = one_interface(sphere(300), 1.0);
  const Vec3 U(0.3, -0.2, 0.5);
  const std::vector<VertexField<Vec3>> v{VertexField<Vec3>(300, U)};
  const InterfaceMotion motion = normal_motion(scene, v, MotionNormal::fit);
  for (const VertexId i : motion[0].ids()) {
    const Vec3 n = scene.interfaces[0].mesh.x[i];
    EXPECT_LT((motion[0][i] - n * n.dot(U)).norm(), 0.02);
  }
}

TEST(InterfaceMotion, SurfaceEnergyRateIsTheAreasDerivative) {
  Scene scene = one_interface(stretched_sphere(150, Vec3(1.2, 0.9, 1.0)), 2.5);
  const SurfaceMesh before = scene.interfaces[0].mesh;
  InterfaceMotion motion{VertexField<Vec3>(150)};
  for (const VertexId i : motion[0].ids())
    motion[0][i] = Vec3(before.x[i].y(), -0.5 * before.x[i].z(), before.x[i].x());
  const double rate = surface_energy_rate(scene, motion), dt = 1e-5;
  move_interfaces(scene, motion, dt);
  const double after = surface_area(scene.interfaces[0].mesh);
  move_interfaces(scene, motion, -2.0 * dt);
  EXPECT_NEAR(rate, 2.5 * (after - surface_area(scene.interfaces[0].mesh)) / (2.0 * dt), 1e-7);
}

}  // namespace
}  // namespace meniscus
