#include "meniscus/evolve/drop_stress.hpp"

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

Scene one_drop(const SurfaceMesh& mesh, double viscosity_ratio, double Ca) {
  Scene scene;
  scene.Ca = Ca;
  scene.liquids.add(Liquid{});
  scene.liquids.add(Liquid{viscosity_ratio, Vec3::Zero()});
  Interface interface;
  interface.mesh = mesh;
  interface.inside = RegionId{1};
  interface.outside = RegionId{0};
  interface.tension = 1.0 / Ca;
  scene.interfaces.push_back(interface);
  return scene;
}

VertexField<Vec3> velocity_on(const SurfaceMesh& mesh, const Mat3& gradient) {
  VertexField<Vec3> u(mesh.num_vertices());
  for (const VertexId v : u.ids()) u[v] = gradient * mesh.x[v];
  return u;
}

TEST(DropStress, LinearVelocityGivesTwiceTheViscosityContrastTimesTheStrain) {
  const Scene scene = one_drop(stretched_sphere(150, Vec3(1.3, 0.8, 1.0)), 4.0, 1e300);
  Mat3 gradient = Mat3::Zero();
  gradient(0, 1) = 1.0;
  const std::vector<VertexField<Vec3>> u{velocity_on(scene.interfaces[0].mesh, gradient)};
  // ∫_S (un + nu) dS = ∫_V (G + Gᵀ) dV: exact on any closed faceted surface.
  const Mat3 expected = 3.0 * (gradient + gradient.transpose());
  EXPECT_LT((drop_stress(scene, u) - expected).norm(), 1e-12);
}

// A drop whose law doubles its viscosity: what the law adds counts as viscosity does.
TEST(DropStress, OfALawCountsLikeThatOfTheViscosityItAddsUpTo) {
  const SurfaceMesh mesh = stretched_sphere(150, Vec3(1.3, 0.8, 1.0));
  Mat3 gradient = Mat3::Zero();
  gradient(0, 1) = 1.0;
  const std::vector<VertexField<Vec3>> u{velocity_on(mesh, gradient)};
  const std::vector<Mat3> excess{Mat3::Zero(),
                                 enclosed_volume(mesh) * 4.0 * (gradient + gradient.transpose())};
  EXPECT_LT(
      (drop_stress(one_drop(mesh, 4.0, 0.3), u, excess) - drop_stress(one_drop(mesh, 8.0, 0.3), u))
          .norm(),
      1e-12);
}

TEST(DropStress, SphereUnderTensionCarriesNoDeviator) {
  const Scene scene = one_drop(sphere(400), 1.0, 0.5);
  const std::vector<VertexField<Vec3>> u{VertexField<Vec3>(400, Vec3::Zero())};
  const Mat3 stress = drop_stress(scene, u);
  EXPECT_NEAR(stress.trace(), 0.0, 1e-12);
  EXPECT_LT(stress.norm(),
            0.02);  // the triangulation is not exactly isotropic: O(1/N) of area/Ca/V = 6
}

TEST(DropStress, SlightlyDeformedDropGivesTaylorsViscosity) {
  // λ = 1, small Ca: steady shape r = 1 + Ca (35/16)·2 n·E·n, E_xy = 1/2 (taylor1934); the viscous
  // part vanishes, so that the capillary part alone carries Taylor's (1 + 5λ/2)/(1 + λ) = 7/4.
  const double Ca = 0.01;
  SurfaceMesh mesh = sphere(1600);
  for (Vec3& x : mesh.x) {
    const Vec3 n = x.normalized();
    x = n * (1.0 + Ca * 35.0 / 16.0 * n.x() * n.y());
  }
  const Scene scene = one_drop(mesh, 1.0, Ca);
  const std::vector<VertexField<Vec3>> u{VertexField<Vec3>(1600, Vec3::Zero())};
  const Mat3 sphere_bias = drop_stress(one_drop(sphere(1600), 1.0, Ca), u);
  EXPECT_NEAR((drop_stress(scene, u) - sphere_bias)(0, 1), 7.0 / 4.0, 0.02);
}

}  // namespace
}  // namespace meniscus
