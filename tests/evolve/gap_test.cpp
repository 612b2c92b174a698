#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/evolve/evolution.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "near_pair.hpp"
#include "prescribed_flow.hpp"

namespace meniscus {
namespace {

Scene remeshed(double gap_layers, int steps) {
  EvolutionOptions options;
  options.gap_layers = gap_layers;
  options.max_step = 1e-3;
  options.end = 1.0;
  Evolution evolution(
      test::near_pair(), options,
      std::make_unique<PrescribedFlow>([](const Vec3&, double) { return Vec3(Vec3::Zero()); }));
  EXPECT_TRUE(evolution.prepare().ok());
  for (int step = 0; step < steps; ++step) {
    EXPECT_TRUE(evolution.solve().ok());
    EXPECT_TRUE(evolution.advance().ok());
  }
  return evolution.scene();
}

TEST(EvolutionGaps, BothSidesComeDownToTheGap) {
  const Scene plain = remeshed(0.0, 3), refined = remeshed(3.0, 3);
  const double gap = smallest_gap(refined.interfaces[0].mesh, refined.interfaces[1].mesh);
  for (const std::size_t i : {0, 1}) {
    EXPECT_GT(shortest_edge(plain.interfaces[i].mesh), 0.15);
    // c/n of the gap, and the spread of l/l0 about 1 that a relaxed mesh has.
    EXPECT_LT(shortest_edge(refined.interfaces[i].mesh), 0.8 / 3.0 * gap * 1.1);
    EXPECT_GT(shortest_edge(refined.interfaces[i].mesh), 0.8 / 3.0 * gap * 0.5);
  }
}

}  // namespace
}  // namespace meniscus
