#include "meniscus/scene/scene_gap.hpp"

#include <algorithm>
#include <ctime>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_check.hpp"
#include "tests/volume/suspension.hpp"

namespace meniscus {
namespace {

/// The pairwise minimum, asked of every two surfaces.
double least_of_all_pairs(const Scene& scene) {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      gap = std::min(gap, smallest_gap(scene.interfaces[i].mesh, scene.interfaces[j].mesh));
    if (!scene.is_unbounded)
      gap = std::min(gap, smallest_gap(scene.interfaces[i].mesh, scene.boundary.mesh));
  }
  return gap;
}

TEST(SceneGap, IsTheLeastOfAllPairs) {
  for (const int drops : {1, 2, 7, 30}) {
    Scene scene = test::suspension(drops, 60, 0.1);
    EXPECT_EQ(smallest_gap(scene), least_of_all_pairs(scene)) << drops << " drops";
    // A drop within the first, nearer to it than any two others to each other.
    test::add_drop(scene, scene.interfaces[0].mesh, RegionId{1});
    Vec3 center = Vec3::Zero();
    for (const Vec3& x : scene.interfaces[0].mesh.x) center += x / 60.0;
    for (Vec3& x : scene.interfaces.back().mesh.x) x = center + 0.97 * (x - center);
    EXPECT_LT(smallest_gap(scene), 0.04);
    EXPECT_EQ(smallest_gap(scene), least_of_all_pairs(scene)) << drops << " drops and one inside";
    scene.is_unbounded = true;
    EXPECT_EQ(smallest_gap(scene), least_of_all_pairs(scene)) << drops << " drops, unbounded";
  }
}

TEST(SceneGap, OfALoneDropIsNone) {
  Scene scene = test::suspension(1, 60, 0.1);
  scene.is_unbounded = true;
  EXPECT_EQ(smallest_gap(scene), std::nullopt);
}

/// Processor time, the least of three [s].
template <class Function>
double least_time(const Function& function) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    function();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

TEST(SceneGap, CostsNLogN) {
  const Scene few = test::suspension(50, 100, 0.1), many = test::suspension(400, 100, 0.1);
  // Eight times the drops: 8 · log 400/log 50 = 12 when n log n, 64 when quadratic.
  EXPECT_LT(least_time([&] { static_cast<void>(smallest_gap(many)); }),
            25.0 * least_time([&] { static_cast<void>(smallest_gap(few)); }));
}

}  // namespace
}  // namespace meniscus
