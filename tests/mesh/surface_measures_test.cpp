#include "meniscus/mesh/surface_measures.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

SurfaceMesh random_shape(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  SurfaceMesh mesh = stretched_sphere(150, Vec3(1.4, 0.8, 1.1), Vec3(3.0, -2.0, 5.0));
  for (Vec3& x : mesh.x) x += Vec3(uniform(random), uniform(random), uniform(random));
  return mesh;
}

TEST(SurfaceMeasures, AreaVectorsAndAreaGradientAreDerivatives) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SurfaceMesh mesh = random_shape(seed);
    const VertexField<Vec3> volume_gradient = vertex_area_vectors(mesh);
    const VertexField<Vec3> gradient = area_gradient(mesh);
    const double step = 1e-5;
    for (const VertexId v : {VertexId{0}, VertexId{17}, VertexId{149}})
      for (int k = 0; k < 3; ++k) {
        const Vec3 kept = mesh.x[v];
        mesh.x[v][k] = kept[k] + step;
        const double volume_plus = enclosed_volume(mesh), area_plus = surface_area(mesh);
        mesh.x[v][k] = kept[k] - step;
        const double volume_minus = enclosed_volume(mesh), area_minus = surface_area(mesh);
        mesh.x[v] = kept;
        // Central differences: roundoff 1e-16 · 10/1e-5 ~ 1e-10, truncation step² ~ 1e-10.
        EXPECT_NEAR(volume_gradient[v][k], (volume_plus - volume_minus) / (2 * step), 3e-9) << seed;
        EXPECT_NEAR(gradient[v][k], (area_plus - area_minus) / (2 * step), 3e-8) << seed;
      }
  }
}

TEST(SurfaceMeasures, CentroidAndMomentsOfAnAffineImageOfTheBox) {
  SurfaceMesh mesh = box(98, Vec3(1.0, 2.0, 3.0)).mesh;
  const Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 center(4.0, -1.0, 2.0);
  for (Vec3& x : mesh.x) x = center + rotation * x;
  EXPECT_NEAR(enclosed_volume(mesh), 48.0, 1e-11);
  EXPECT_LT((enclosed_centroid(mesh) - center).norm(), 1e-12);
  const Mat3 exact =
      rotation * (48.0 / 3.0 * Vec3(1.0, 4.0, 9.0)).asDiagonal() * rotation.transpose();
  EXPECT_LT((enclosed_second_moments(mesh) - exact).norm(), 1e-10);
}

TEST(SurfaceTopology, RingsAreOrderedAndEulerHolds) {
  const SurfaceMesh mesh = random_shape(3);
  const SurfaceTopology topology(mesh);
  EXPECT_EQ(mesh.num_vertices() - static_cast<int>(topology.edges().size()) + mesh.num_faces(), 2);
  for (const VertexId v : mesh.x.ids()) {
    const auto ring = topology.ring(v);
    const auto faces = topology.faces_around(v);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const FaceVertices& f = mesh.faces[faces[k]];
      const std::size_t at = static_cast<std::size_t>(std::ranges::find(f, v) - f.begin());
      ASSERT_LT(at, 3u);
      EXPECT_EQ(f[(at + 1) % 3], ring[k]);
      EXPECT_EQ(f[(at + 2) % 3], ring[(k + 1) % ring.size()]);
    }
  }
}

TEST(SurfaceTopology, RejectsOpenAndNonManifoldSurfaces) {
  SurfaceMesh open = sphere(42);
  std::vector<FaceVertices> faces(open.faces.begin(), open.faces.end() - 1);
  open.faces = FaceField<FaceVertices>(faces);
  EXPECT_THROW(SurfaceTopology{open}, InvalidInput);
  SurfaceMesh flipped = sphere(42);
  std::swap(flipped.faces[FaceId{5}][0], flipped.faces[FaceId{5}][1]);
  EXPECT_THROW(SurfaceTopology{flipped}, InvalidInput);
  SurfaceMesh doubled = sphere(42);
  doubled.faces.add(doubled.faces[FaceId{0}]);
  EXPECT_THROW(SurfaceTopology{doubled}, InvalidInput);
}

}  // namespace
}  // namespace meniscus
