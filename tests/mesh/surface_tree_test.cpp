#include "meniscus/mesh/surface_tree.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"

namespace meniscus {
namespace {

Vec3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> uniform(-reach, reach);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

Triangle corners(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return {mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]};
}

TEST(SurfaceTree, FindsWhatBruteForceFinds) {
  std::mt19937 random(11);
  for (const SurfaceMesh& mesh : {stretched_sphere(300, Vec3(2.0, 0.5, 1.0)),
                                  box(150, Vec3(1.0, 1.0, 0.2)).mesh, sphere(12)}) {
    const SurfaceTree tree(mesh);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 p = random_point(random, 2.5);
      double least = 1e300, first = 1e300;
      const Vec3 direction = random_point(random, 1.0).normalized();
      for (const FaceId f : mesh.faces.ids()) {
        least = std::min(least, (closest_point(corners(mesh, f), p).point - p).norm());
        const auto hit = intersect_ray(corners(mesh, f), p, direction);
        if (hit) first = std::min(first, hit->t);
      }
      const SurfaceTree::Hit near = tree.closest(p);
      EXPECT_DOUBLE_EQ(near.distance, least);
      EXPECT_NEAR((near.point - p).norm(), least, 1e-14);
      EXPECT_LE(tree.closest(p, 1e300, 0.2).distance, 1.2 * least);
      EXPECT_FALSE(tree.closest(p, 0.9 * least).face.is_valid());
      EXPECT_TRUE(tree.closest(p, 1.1 * least).face.is_valid());
      const auto hit = tree.first_hit(p, direction);
      ASSERT_EQ(hit.has_value(), first < 1e300);
      if (hit) {
        EXPECT_DOUBLE_EQ(hit->distance, first);
      }
    }
  }
}

TEST(SurfaceTree, VisitsEveryTwoFacesWhoseBoxesTouchOnce) {
  for (const SurfaceMesh& mesh :
       {stretched_sphere(150, Vec3(2.0, 0.5, 1.0)), box(100, Vec3(1.0, 1.0, 0.2)).mesh}) {
    const auto boxes_touch = [&](FaceId f, FaceId g) {
      const Triangle s = corners(mesh, f), t = corners(mesh, g);
      const auto low = [](const Triangle& x) { return Vec3(x[0].cwiseMin(x[1]).cwiseMin(x[2])); };
      const auto high = [](const Triangle& x) { return Vec3(x[0].cwiseMax(x[1]).cwiseMax(x[2])); };
      return (low(s).array() <= high(t).array()).all() && (low(t).array() <= high(s).array()).all();
    };
    std::vector<std::pair<FaceId, FaceId>> expected, visited;
    for (const FaceId f : mesh.faces.ids())
      for (const FaceId g : mesh.faces.ids())
        if (f < g && boxes_touch(f, g)) expected.emplace_back(f, g);
    const SurfaceTree tree(mesh);
    tree.visit_touching_pairs([&](FaceId f, const Triangle& s, FaceId g, const Triangle& t) {
      EXPECT_EQ(s, corners(mesh, f));
      EXPECT_EQ(t, corners(mesh, g));
      visited.emplace_back(std::min(f, g), std::max(f, g));
      return true;
    });
    std::ranges::sort(visited);
    EXPECT_EQ(visited, expected);
    int num_visited = 0;
    tree.visit_touching_pairs(
        [&](FaceId, const Triangle&, FaceId, const Triangle&) { return ++num_visited < 5; });
    EXPECT_EQ(num_visited, 5);
  }
}

TEST(SurfaceTree, LetsNoRayEscapeThroughEdges) {
  // From inside a closed surface every ray meets it, through vertices and edge middles too, and
  // along the axes, where boxes are flat.
  for (const SurfaceMesh& mesh : {sphere(200), box(150, Vec3(1.0, 2.0, 0.5)).mesh}) {
    const SurfaceTree tree(mesh);
    const Vec3 origin(0.01, 0.02, 0.03);
    for (const FaceVertices& f : mesh.faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = mesh.x[f[k]], b = mesh.x[f[(k + 1) % 3]];
        EXPECT_TRUE(tree.first_hit(origin, (a - origin).normalized()).has_value());
        EXPECT_TRUE(tree.first_hit(origin, (0.5 * (a + b) - origin).normalized()).has_value());
      }
    for (int k = 0; k < 3; ++k)
      for (const double sign : {-1.0, 1.0}) {
        EXPECT_TRUE(tree.first_hit(origin, sign * Vec3::Unit(k)).has_value());
        EXPECT_TRUE(tree.first_hit(Vec3::Zero(), sign * Vec3::Unit(k)).has_value());
      }
  }
}

TEST(SurfaceTree, VisitsEveryFaceInABox) {
  const SurfaceMesh mesh = sphere(400);
  const SurfaceTree tree(mesh);
  const Vec3 low(0.2, -0.3, 0.1), high(0.9, 0.4, 1.2);
  int expected = 0, visited = 0;
  for (const FaceId f : mesh.faces.ids()) {
    const Triangle x = corners(mesh, f);
    const Vec3 l = x[0].cwiseMin(x[1]).cwiseMin(x[2]), h = x[0].cwiseMax(x[1]).cwiseMax(x[2]);
    expected += (l.array() <= high.array()).all() && (low.array() <= h.array()).all() ? 1 : 0;
  }
  tree.visit_box(low, high, [&](FaceId, const Triangle&) { return ++visited > 0; });
  EXPECT_GT(expected, 20);
  EXPECT_EQ(visited, expected);
  visited = 0;
  tree.visit_box(low, high, [&](FaceId, const Triangle&) { return ++visited < 3; });
  EXPECT_EQ(visited, 3);
}

TEST(SurfaceTree, VisitsEveryFaceNearForItsSize) {
  const SurfaceMesh mesh = stretched_sphere(400, Vec3(2.5, 0.5, 0.1));
  const SurfaceTree tree(mesh);
  std::mt19937 random(11);
  int num_near = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 x = random_point(random, 2.0);
    FaceField<int> expected(mesh.num_faces(), 0), visits(mesh.num_faces(), 0);
    for (const FaceId f : mesh.faces.ids()) {
      const Triangle c = corners(mesh, f);
      const Vec3 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]),
                 high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
      const double distance = (x - x.cwiseMax(low).cwiseMin(high)).norm();
      expected[f] = distance < 3.0 * (high - low).norm() ? 1 : 0;
      num_near += expected[f];
    }
    tree.visit_near(x, 3.0, [&](FaceId f, const Triangle&) { return ++visits[f] > 0; });
    for (const FaceId f : mesh.faces.ids()) EXPECT_EQ(visits[f], expected[f]) << f.value;
  }
  EXPECT_GT(num_near, 1000);
}

TEST(SurfaceTree, VisitsEveryFaceThatAPlaneCutsInABox) {
  const SurfaceMesh mesh = stretched_sphere(400, Vec3(1.5, 0.5, 1.0));
  const SurfaceTree tree(mesh);
  std::mt19937 random(7);
  const Vec3 half = Vec3::Constant(0.6);
  int num_cut = 0, num_visited = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 origin = random_point(random, 1.0), normal = random_point(random, 1.0).normalized();
    FaceField<char> is_visited(mesh.num_faces(), false), is_in_box(mesh.num_faces(), false);
    tree.visit_slice(origin - half, origin + half, origin, normal,
                     [&](FaceId f, const Triangle&) { return is_visited[f] = true; });
    tree.visit_box(origin - half, origin + half,
                   [&](FaceId f, const Triangle&) { return is_in_box[f] = true; });
    for (const FaceId f : mesh.faces.ids()) {
      const Triangle x = corners(mesh, f);
      const auto is_above = [&](const Vec3& p) { return normal.dot(p - origin) >= 0.0; };
      const bool is_cut = is_above(x[0]) != is_above(x[1]) || is_above(x[0]) != is_above(x[2]);
      EXPECT_TRUE(is_in_box[f] || !is_visited[f]);
      EXPECT_TRUE(is_visited[f] || !(is_cut && is_in_box[f]));
      num_cut += is_cut && is_in_box[f] ? 1 : 0;
      num_visited += is_visited[f] ? 1 : 0;
    }
  }
  EXPECT_GT(num_cut, 200);
  EXPECT_LT(num_visited, 4 * num_cut);  // boxes are larger than their faces
}

}  // namespace
}  // namespace meniscus
