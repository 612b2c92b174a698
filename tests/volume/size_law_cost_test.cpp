#include <algorithm>
#include <ctime>
#include <limits>

#include <gtest/gtest.h>

#include "meniscus/volume/size_law.hpp"
#include "tests/volume/suspension.hpp"

namespace meniscus {
namespace {

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

double time_of_law(int drops, double gap_layers) {
  const Scene scene = test::suspension(drops, 100, 0.1);
  VolumeMeshOptions options;
  options.gap_layers = gap_layers;
  const SizeLaw law(scene, options);
  const std::vector<Vec3> points = test::points_around_drops(scene, 20);
  double sum = 0.0;
  const double time = least_time([&] {
    for (const Vec3& x : points) sum += law(x);
  });
  EXPECT_GT(sum, 0.0);
  return time / static_cast<double>(points.size());
}

TEST(SizeLaw, CostsAsMuchAVertexInManyDropsAsInFew) {
  // All drops asked, a vertex costs 16 times as much; gaps of all pairs 256 times.
  for (const double gap_layers : {0.0, 3.0})
    EXPECT_LT(time_of_law(400, gap_layers), 2.5 * time_of_law(25, gap_layers))
        << gap_layers << " layers";
}

}  // namespace
}  // namespace meniscus
