#include "meniscus/mesh/surface_distance.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "tests/mesh/octahedron.hpp"

namespace meniscus {
namespace {

TEST(SurfaceDistance, OfShiftedBoxes) {
  const SurfaceMesh a = box(200, Vec3::Ones()).mesh;
  SurfaceMesh b = a;
  for (Vec3& x : b.x) x += Vec3(0.3, 0, 0);
  for (const SampledDistance& d : {directed_distance(a, b), hausdorff_distance(a, b)}) {
    EXPECT_NEAR(d.distance, 0.3, 1e-14);
    EXPECT_LE(d.error, 0.003 + 1e-12);
    EXPECT_NEAR((d.from - d.to).norm(), d.distance, 1e-14);
  }
}

TEST(SurfaceDistance, IsNotSymmetricUntilBothWaysAreTaken) {
  // From the small box the farthest point of the large one is its corner; from the large one the
  // small one's is anywhere.
  const SurfaceMesh small = box(26, Vec3::Ones()).mesh, large = box(26, 2.0 * Vec3::Ones()).mesh;
  EXPECT_NEAR(directed_distance(small, large).distance, 1.0, 1e-14);
  EXPECT_NEAR(directed_distance(large, small).distance, std::sqrt(3.0), 1e-14);
  const SampledDistance both = hausdorff_distance(small, large);
  EXPECT_NEAR(both.distance, std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(both.from.cwiseAbs().maxCoeff(), 1.0, 1e-14);  // a point of the first
}

TEST(SurfaceDistance, FindsTheSagBetweenVertices) {
  // The octahedron's faces lie deepest below its sphere at their centres, 1/√3 from the middle. The
  // fine one's vertices lie outside the unit sphere by 1.8/N, its faces inside by as much.
  const SurfaceMesh coarse = test::octahedron(), fine = sphere(4000);
  const SampledDistance d = directed_distance(coarse, fine, {.relative_error = 1e-3});
  EXPECT_NEAR(d.distance, 1.0 - 1.0 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(d.from.cwiseAbs().maxCoeff(), 1.0 / 3.0, 0.02);
}

TEST(SurfaceDistance, BoundsWhatRandomPointsFind) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Vec3& axes : {Vec3(1, 1, 1), Vec3(2, 1, 0.5)}) {
    const SurfaceMesh a = stretched_sphere(300, axes), b = stretched_sphere(500, axes);
    const SampledDistance d = directed_distance(a, b);
    const SurfaceTree tree(b);
    double found = 0.0;
    for (int i = 0; i < 40000; ++i) {
      const FaceId f{static_cast<std::int32_t>(uniform(random) * a.num_faces())};
      const double r = std::sqrt(uniform(random)), s = uniform(random);
      const FaceVertices& v = a.faces[f];
      const Vec3 x = (1.0 - r) * a.x[v[0]] + r * (1.0 - s) * a.x[v[1]] + r * s * a.x[v[2]];
      found = std::max(found, tree.closest(x).distance);
    }
    EXPECT_LE(found, d.distance + d.error) << "seed 11";
    EXPECT_GT(found, 0.9 * d.distance);
    EXPECT_LE(d.error, 0.01 * d.distance + 1e-12);
  }
}

TEST(SurfaceDistance, OfASurfaceFromItselfIsZero) {
  const SurfaceMesh mesh = sphere(300);
  const SampledDistance d = hausdorff_distance(mesh, mesh);
  EXPECT_LT(d.distance, 1e-15);
  EXPECT_LT(d.error, 1e-4);
}

}  // namespace
}  // namespace meniscus
