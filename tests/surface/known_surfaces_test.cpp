#include "meniscus/surface/known_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

SurfaceMesh drop(double stretch) { return stretched_sphere(60, {stretch, 1.0, 1.0}); }

/// Counts the fits and middles that it is asked to share out.
KnownSurfaces counted(int& count) {
  return KnownSurfaces([&count](std::size_t num_items, std::size_t, const FindNumbers& find) {
    ++count;
    return find(0, num_items);
  });
}

TEST(KnownSurfaces, AreMadeOnceForEqualVertices) {
  int count = 0;
  KnownSurfaces known = counted(count);
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

TEST(KnownSurfaces, KnowsAScaledMeshWithoutNewFits) {
  int count = 0;
  KnownSurfaces known = counted(count);
  SurfaceMesh mesh = drop(1.5);
  const double volume = known.of(mesh, SurfaceShape::splined)->volume();
  EXPECT_EQ(count, 2);  // fits and middles
  const Dilation dilation{Vec3(0.3, -0.2, 0.1), 1.01};
  known.scale(mesh, SurfaceShape::splined, dilation);
  const auto scaled = known.of(mesh, SurfaceShape::splined);
  EXPECT_EQ(count, 2);
  EXPECT_NEAR(scaled->volume(), volume * std::pow(1.01, 3), 1e-14 * volume);

  const ReconstructedSurface fitted(mesh, SurfaceShape::splined);
  ASSERT_EQ(scaled->middles().size(), fitted.middles().size());
  for (std::size_t e = 0; e < fitted.middles().size(); ++e)
    EXPECT_LT((scaled->middles()[e] - fitted.middles()[e]).norm(), 1e-13);
  for (const VertexId v : mesh.x.ids()) {
    const VertexCurvature &here = scaled->smooth()->vertex_curvature()[v],
                          &there = fitted.smooth()->vertex_curvature()[v];
    EXPECT_LT((here.n - there.n).norm(), 1e-12);
    EXPECT_NEAR(here.k1, there.k1, 1e-11);
    EXPECT_NEAR(here.k2, there.k2, 1e-11);
  }
  for (const FaceId f : mesh.faces.ids()) {
    const Vec3 weights(0.2, 0.3, 0.5);
    EXPECT_LT((scaled->smooth()->point(f, weights) - fitted.smooth()->point(f, weights)).norm(),
              1e-13);
  }
}

TEST(KnownSurfaces, ChangesTheScaleOfAnUnknownMeshTwice) {
  KnownSurfaces known;
  SurfaceMesh mesh = drop(1.5);
  const double volume = ReconstructedSurface(mesh, SurfaceShape::patched).volume();
  for (int k = 0; k < 2; ++k)
    known.scale(mesh, SurfaceShape::patched, {.center = Vec3::Zero(), .factor = 1.1});
  EXPECT_NEAR(known.of(mesh, SurfaceShape::patched)->volume(), volume * std::pow(1.1, 6),
              1e-13 * volume);
}

TEST(KnownSurfaces, LoadTheSameBytes) {
  KnownSurfaces known, resumed;
  SurfaceMesh mesh = drop(1.5), plain = drop(1.6);
  known.scale(mesh, SurfaceShape::splined, {.center = Vec3(0.3, 0.0, 0.0), .factor = 0.999});
  (void)known.of(plain, SurfaceShape::splined);
  Archive archive;
  known.save(mesh, archive, "mesh");
  known.save(plain, archive, "plain");
  EXPECT_EQ(archive.reals.count("plain/x"), 0u);
  resumed.load(mesh, archive, "mesh");
  resumed.load(plain, archive, "plain");
  EXPECT_EQ(resumed.size(), 1u);
  const auto expected = known.of(mesh, SurfaceShape::splined),
             found = resumed.of(mesh, SurfaceShape::splined);
  EXPECT_TRUE(std::ranges::equal(found->middles(), expected->middles()));
  EXPECT_EQ(found->smooth()->vertex_normals(), expected->smooth()->vertex_normals());
  const ReconstructedSurface fitted(mesh, SurfaceShape::splined);
  EXPECT_FALSE(std::ranges::equal(fitted.middles(), expected->middles()));
}

TEST(KnownSurfaces, RefusesWhatIsNotTheMeshs) {
  KnownSurfaces known;
  SurfaceMesh mesh = drop(1.5);
  known.scale(mesh, SurfaceShape::splined, {.center = Vec3::Zero(), .factor = 0.99});
  Archive archive;
  known.save(mesh, archive, "mesh");
  const auto loaded = [&mesh](Archive damaged) {
    KnownSurfaces fresh;
    fresh.load(mesh, damaged, "mesh");
  };
  EXPECT_NO_THROW(loaded(archive));
  Archive damaged = archive;
  damaged.reals["mesh/x"][4] += 1e-9;
  EXPECT_THROW(loaded(damaged), InvalidInput);
  damaged = archive;
  damaged.reals["mesh/x"].pop_back();
  EXPECT_THROW(loaded(damaged), InvalidInput);
  damaged = archive;
  damaged.reals["mesh/dilation"][3] = std::nan("");
  EXPECT_THROW(loaded(damaged), InvalidInput);
  damaged = archive;
  damaged.integers["mesh/shape"] = {7};
  EXPECT_THROW(loaded(damaged), InvalidInput);
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
