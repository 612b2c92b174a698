#include <gtest/gtest.h>

#include "meniscus/volume/size_law.hpp"
#include "tests/volume/suspension.hpp"

namespace meniscus {
namespace {

/// Nearest points that the law looks for at a vertex of the volume mesh: each is a walk down the
/// tree of one surface, all of its cost but finding which surfaces are near.
double searches_of_law(const Scene& scene, double gap_layers) {
  VolumeMeshOptions options;
  options.gap_layers = gap_layers;
  const SizeLaw law(scene, options);
  const std::vector<Vec3> points = test::points_around_drops(scene, 20);
  double sum = 0.0;
  for (const Vec3& x : points) sum += law(x);
  EXPECT_GT(sum, 0.0);
  return static_cast<double>(law.num_searches()) / static_cast<double>(points.size());
}

TEST(SizeLaw, LooksForAsManyNearestPointsInManyDropsAsInFew) {
  // All drops asked, a vertex costs 16 times as much; gaps of all pairs 256 times.
  const Scene few = test::suspension(25, 100, 0.1), many = test::suspension(400, 100, 0.1);
  for (const double gap_layers : {0.0, 3.0})
    EXPECT_LT(searches_of_law(many, gap_layers), 1.3 * searches_of_law(few, gap_layers))
        << gap_layers << " layers";
}

}  // namespace
}  // namespace meniscus
