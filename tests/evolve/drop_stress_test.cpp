#include "meniscus/evolve/drop_stress.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/evolve/measures.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

Mat3 stress_of(const Scene& scene, std::span<const VertexField<Vec3>> velocity, SurfaceShape shape,
               std::span<const Mat3> excess = {}) {
  KnownSurfaces known;
  return drop_stress(scene, velocity, reconstructed_interfaces(scene, shape, known), excess);
}

Scene one_drop(const SurfaceMesh& mesh, double viscosity_ratio, double Ca) {
  Scene scene;
  scene.Ca = Ca;
  scene.liquids.add(Liquid{});
  scene.liquids.add({.viscosity = viscosity_ratio});
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
  EXPECT_LT((stress_of(scene, u, SurfaceShape::faceted) - expected).norm(), 1e-12);
}

// A drop whose law doubles its viscosity: what the law adds counts as viscosity does.
TEST(DropStress, OfALawCountsLikeThatOfTheViscosityItAddsUpTo) {
  const SurfaceMesh mesh = stretched_sphere(150, Vec3(1.3, 0.8, 1.0));
  Mat3 gradient = Mat3::Zero();
  gradient(0, 1) = 1.0;
  const std::vector<VertexField<Vec3>> u{velocity_on(mesh, gradient)};
  const std::vector<Mat3> excess{Mat3::Zero(),
                                 enclosed_volume(mesh) * 4.0 * (gradient + gradient.transpose())};
  EXPECT_LT((stress_of(one_drop(mesh, 4.0, 0.3), u, SurfaceShape::faceted, excess) -
             stress_of(one_drop(mesh, 8.0, 0.3), u, SurfaceShape::faceted))
                .norm(),
            1e-12);
}

TEST(DropStress, SphereUnderTensionCarriesNoDeviator) {
  const Scene scene = one_drop(sphere(400), 1.0, 0.5);
  const std::vector<VertexField<Vec3>> u{VertexField<Vec3>(400, Vec3::Zero())};
  const Mat3 stress = stress_of(scene, u, SurfaceShape::faceted);
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
  const Mat3 sphere_bias = stress_of(one_drop(sphere(1600), 1.0, Ca), u, SurfaceShape::faceted);
  EXPECT_NEAR((stress_of(scene, u, SurfaceShape::faceted) - sphere_bias)(0, 1), 7.0 / 4.0, 0.02);
}

/// Relative error of Σ = ∫_V (G + Gᵀ) dV (λ − 1)/V of an ellipsoid of half-axes 1.3, 0.8, 1 in
/// u = (x y², z/2, −z y²), where ∫ y² dV = 0.8²/5 V.
double viscous_error(int num_vertices, SurfaceShape faces) {
  const SurfaceMesh mesh = stretched_sphere(num_vertices, Vec3(1.3, 0.8, 1.0));
  VertexField<Vec3> u(mesh.num_vertices());
  for (const VertexId v : u.ids()) {
    const Vec3& x = mesh.x[v];
    u[v] = Vec3(x.x() * x.y() * x.y(), 0.5 * x.z(), -x.z() * x.y() * x.y());
  }
  const std::vector<VertexField<Vec3>> velocity{std::move(u)};
  Mat3 exact = 3.0 * Vec3(0.256, 0.0, -0.256).asDiagonal().toDenseMatrix();
  exact(1, 2) = exact(2, 1) = 1.5;
  return (stress_of(one_drop(mesh, 4.0, 1e300), velocity, faces) - exact).norm() / exact.norm();
}

// Velocities between the vertices are good to O(h³).
TEST(DropStress, OfCurvedFacesConvergesToThirdOrder) {
  for (const SurfaceShape faces : {SurfaceShape::patched, SurfaceShape::splined}) {
    std::vector<double> error;
    for (const int num_vertices : {200, 400, 800})
      error.push_back(viscous_error(num_vertices, faces));
    EXPECT_LT(error[1], 3e-4);                       // h³/16 with edges of 0.17
    EXPECT_GT(std::log2(error[0] / error[2]), 2.7);  // h halves from 200 to 800
  }
}

// As with flat faces above, on a quarter of the vertices and with no bias of the sphere to be taken
// out: that of flat faces is up to 1.
TEST(DropStress, OfCurvedFacesGivesTaylorsViscosity) {
  const double Ca = 0.01;
  const VertexField<Vec3> rest(400, Vec3::Zero());
  const auto stress = [&](const SurfaceMesh& mesh, SurfaceShape faces) {
    return stress_of(one_drop(mesh, 1.0, Ca), std::vector{rest}, faces);
  };
  SurfaceMesh deformed = sphere(400);
  for (Vec3& x : deformed.x) {
    const Vec3 n = x.normalized();
    x = n * (1.0 + Ca * 35.0 / 16.0 * n.x() * n.y());
  }
  for (const SurfaceShape faces : {SurfaceShape::patched, SurfaceShape::splined}) {
    EXPECT_LT(stress(sphere(400), faces).norm(), 0.01);
    EXPECT_NEAR(stress(deformed, faces)(0, 1), 7.0 / 4.0, 0.02);
  }
}

}  // namespace
}  // namespace meniscus
