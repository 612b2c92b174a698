#include "meniscus/topology/gaps.hpp"

#include <array>
#include <cmath>
#include <ctime>
#include <limits>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

constexpr double kLimit = 0.2;

/// A cube of pairs of spheres of 60 vertices, those of a pair 0.01 apart (and the depth of their
/// faces, 0.1), pairs nearly 1.
std::vector<SurfaceMesh> pairs_of_drops(int pairs) {
  std::vector<SurfaceMesh> meshes;
  const SurfaceMesh drop = sphere(60);
  const int edge = static_cast<int>(std::ceil(std::cbrt(pairs)));
  for (int i = 0; i < pairs; ++i) {
    const Vec3 corner(5.0 * (i % edge), 3.0 * (i / edge % edge), 3.0 * (i / edge / edge));
    for (const double along : {0.0, 2.01}) {
      SurfaceMesh& moved = meshes.emplace_back(drop);
      for (Vec3& x : moved.x) x += corner + Vec3(along, 0, 0);
    }
  }
  return meshes;
}

void expect_same(const std::vector<Gap>& gaps, const std::vector<Gap>& others) {
  ASSERT_EQ(gaps.size(), others.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    EXPECT_EQ(gaps[i].a, others[i].a);
    EXPECT_EQ(gaps[i].b, others[i].b);
    EXPECT_EQ(gaps[i].side, others[i].side);
    EXPECT_EQ(gaps[i].width, others[i].width);
    EXPECT_EQ(gaps[i].from, others[i].from);
    EXPECT_EQ(gaps[i].to, others[i].to);
    EXPECT_EQ(gaps[i].patch, others[i].patch);
  }
}

TEST(GapSearch, LooksOnlyAtWhatAnEventChanged) {
  Scene scene = test::scene_of(pairs_of_drops(10));
  const SurfaceMotion motion;
  GapSearch search(kLimit, motion);
  ASSERT_EQ(search.gaps(scene).size(), 10U);
  const std::int64_t at_first = search.num_searches();
  expect_same(search.gaps(scene), find_gaps(scene, kLimit, motion));
  EXPECT_EQ(search.num_searches(), at_first);
  // Two drops give way to one, as by a merger: others move up and their regions are renumbered.
  Interface merged = scene.interfaces[2];
  merged.drop = 20;
  scene.interfaces.erase(scene.interfaces.begin() + 2, scene.interfaces.begin() + 4);
  scene.interfaces.push_back(merged);
  scene.liquids.resize(20);
  assign_regions(scene);
  expect_same(search.gaps(scene), find_gaps(scene, kLimit, motion));
  EXPECT_EQ(search.gaps(scene).size(), 9U);
  EXPECT_LE(search.num_searches() - at_first, 2);  // the new drop, and no more than one pair
}

TEST(GapSearch, SeesThatAFilmLiesElsewhereNow) {
  // A drop in a shell: without the shell its film towards a drop outside is another.
  const std::vector<SurfaceMesh> meshes{sphere(200, 1.0), sphere(200, 0.98),
                                        sphere(200, 1.0, Vec3(2.04, 0, 0))};
  Scene scene = test::scene_of(meshes);
  const SurfaceMotion motion;
  GapSearch search(kLimit, motion);
  expect_same(search.gaps(scene), find_gaps(scene, kLimit, motion));
  scene.interfaces.erase(scene.interfaces.begin());
  scene.liquids.resize(3);
  assign_regions(scene);
  const std::vector<Gap> gaps = search.gaps(scene);
  expect_same(gaps, find_gaps(scene, kLimit, motion));
  EXPECT_EQ(gaps.size(), 1U);
}

/// Processor time of a search, the least of three [s].
double least_time(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    EXPECT_FALSE(find_gaps(scene, kLimit, {}).empty());
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// The poles of a long drop within a round one are two films.
TEST(FindGaps, GivesEachFilmItsOwnPatch) {
  const double half = 0.97;
  Scene scene =
      test::scene_of(std::array{sphere(500), stretched_sphere(300, Vec3(half, 0.5, 0.5))});
  scene.interfaces[1].outside = scene.interfaces[0].inside;
  const std::vector<Gap> gaps = find_gaps(scene, 0.05, SurfaceMotion());
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_LT(gaps[0].middle().x() * gaps[1].middle().x(), 0.0);
  for (const Gap& gap : gaps) {
    EXPECT_FALSE(gap.patch.empty());
    for (const Vec3& x : gap.patch) EXPECT_LT((x - gap.middle()).norm(), 0.5);
  }
}

TEST(FindGaps, CostsNLogN) {
  const Scene few = test::scene_of(pairs_of_drops(25)), many = test::scene_of(pairs_of_drops(200));
  // Eight times the drops: 8 · log 400/log 50 = 12 when n log n, 64 when quadratic.
  EXPECT_LT(least_time(many), 25.0 * least_time(few));
}

}  // namespace
}  // namespace meniscus
