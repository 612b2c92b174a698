#include "meniscus/surface/known_surfaces.hpp"

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

SurfaceMesh drop(double stretch) { return stretched_sphere(60, {stretch, 1.0, 1.0}); }

TEST(KnownSurfaces, AreMadeOnceForEqualVertices) {
  int count = 0;
  KnownSurfaces known(
      [&](const SurfaceMesh& mesh, const SurfaceTopology& topology, const SmoothSurface& smooth) {
        ++count;
        return middles_on_splines(mesh, topology, smooth);
      });
  const auto first = known.of(drop(1.5), SurfaceShape::splined);
  EXPECT_EQ(known.of(drop(1.5), SurfaceShape::splined), first);
  EXPECT_EQ(count, 1);
  EXPECT_NE(known.of(drop(1.6), SurfaceShape::splined), first);
  EXPECT_EQ(count, 2);
}

TEST(KnownSurfaces, AreWhatAReconstructionIs) {
  const SurfaceMesh mesh = drop(2.0);
  KnownSurfaces shared(
      [](const SurfaceMesh& of, const SurfaceTopology& topology, const SmoothSurface& smooth) {
        return middles_on_splines(of, topology, smooth);
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
