// What a suspension of many drops costs, at one volume fraction: microseconds of the size law for
// each vertex of the volume mesh, and milliseconds of smallest_gap.

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "meniscus/scene/scene_gap.hpp"
#include "meniscus/volume/size_law.hpp"
#include "tests/volume/suspension.hpp"

namespace {

using namespace meniscus;

/// Of the processor, the least of five.
template <class Function>
double seconds(const Function& function) {
  double least = 1e300;
  for (int i = 0; i < 5; ++i) {
    const std::clock_t start = std::clock();
    function();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

double microseconds_of_law(const Scene& scene, double gap_layers) {
  VolumeMeshOptions options;
  options.gap_layers = gap_layers;
  const SizeLaw law(scene, options);
  const std::vector<Vec3> points = test::points_around_drops(scene, 20);
  double sum = 0.0;
  const double time = seconds([&] {
    for (const Vec3& x : points) sum += law(x);
  });
  std::printf("  sum of sizes %.17g\n", sum);
  return 1e6 * time / static_cast<double>(points.size());
}

}  // namespace

int main() {
  std::printf("drops  law [us a vertex]  with 3 gap layers  smallest gap [ms]\n");
  for (const int drops : {25, 100, 400}) {
    const Scene scene = test::suspension(drops, 100, 0.1);
    const double plain = microseconds_of_law(scene, 0.0), layered = microseconds_of_law(scene, 3.0);
    double gap = 0.0;
    const double time = seconds([&] { gap = smallest_gap(scene).value(); });
    std::printf("%5d  %18.2f  %17.2f  %17.2f  (%.17g)\n", drops, plain, layered, 1e3 * time, gap);
  }
  return 0;
}
