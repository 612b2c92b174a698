#include "meniscus/surface/known_surfaces.hpp"

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

SurfaceMesh drop(double stretch) { return stretched_sphere(60, {stretch, 1.0, 1.0}); }

TEST(KnownSurfaces, AreMadeOnceForEqualVertices) {
  int count = 0;
  KnownSurfaces known([&](std::size_t num_items, std::size_t, const FindNumbers& find) {
    ++count;
    return find(0, num_items);
  });
  const auto first = known.of(drop(1.5), SurfaceShape::splined);
  EXPECT_EQ(known.of(drop(1.5), SurfaceShape::splined), first);
  EXPECT_EQ(count, 2);  // fits and middles
  EXPECT_NE(known.of(drop(1.6), SurfaceShape::splined), first);
  EXPECT_EQ(count, 4);
}

TEST(KnownSurfaces, AreWhatAReconstructionIs) {
  const SurfaceMesh mesh = drop(2.0);
  KnownSurfaces shared([](std::size_t count, std::size_t width, const FindNumbers& find) {
    std::vector<double> all;  // found in three parts, as by ranks
    for (std::size_t part = 0; part < 3; ++part) {
      const std::vector<double> found = find(count * part / 3, count * (part + 1) / 3);
      EXPECT_EQ(found.size(), width * (count * (part + 1) / 3 - count * part / 3));
      all.insert(all.end(), found.begin(), found.end());
    }
    return all;
  });
  KnownSurfaces alone;
  for (const SurfaceShape shape :
       {SurfaceShape::faceted, SurfaceShape::patched, SurfaceShape::splined}) {
    const ReconstructedSurface expected(mesh, shape);
    for (KnownSurfaces* known : {&shared, &alone}) {
      EXPECT_EQ(known->of(mesh, shape)->volume(), expected.volume());
      EXPECT_EQ(known->of(mesh, shape)->area(), expected.area());
    }
  }
  EXPECT_EQ(alone.size(), 3u);
}

TEST(KnownSurfaces, ForgetsWhatNobodyAsksFor) {
  KnownSurfaces known;
  const auto kept = known.of(drop(1.5), SurfaceShape::patched);
  (void)known.of(drop(1.6), SurfaceShape::patched);
  known.forget_unasked();
  EXPECT_EQ(known.size(), 2u);
  EXPECT_EQ(known.of(drop(1.5), SurfaceShape::patched), kept);
  known.forget_unasked();
  EXPECT_EQ(known.size(), 1u);
  known.forget_unasked();
  EXPECT_EQ(known.size(), 0u);
  EXPECT_GT(kept->volume(), 0.0);  // it outlives its entry
}

}  // namespace
}  // namespace meniscus
