#include "meniscus/geometry/triangle.hpp"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/geometry/predicates.hpp"

namespace meniscus {
namespace {

Vec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

TEST(ClosestPoint, FindsEachPartOfATriangle) {
  const Triangle t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_EQ(closest_point(t, Vec3(0.25, 0.25, 3.0)).point, Vec3(0.25, 0.25, 0.0));
  EXPECT_EQ(closest_point(t, Vec3(0.5, -1.0, 1.0)).point, Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(closest_point(t, Vec3(2.0, 2.0, 1.0)).point, Vec3(0.5, 0.5, 0.0));
  EXPECT_EQ(closest_point(t, Vec3(-1.0, 0.25, 0.0)).point, Vec3(0.0, 0.25, 0.0));
  EXPECT_EQ(closest_point(t, Vec3(-1.0, -2.0, 5.0)).point, t[0]);
  EXPECT_EQ(closest_point(t, Vec3(3.0, -1.0, 0.0)).point, t[1]);
  EXPECT_EQ(closest_point(t, Vec3(-0.5, 2.0, 0.0)).point, t[2]);
  // Beyond the edge 0–1 seen from the plane, but nearest to the edge 1–2 of this obtuse triangle.
  const Triangle obtuse{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 1, 0)};
  EXPECT_EQ(closest_point(obtuse, Vec3(2.0, 0.0, 0.0)).weights[0], 0.0);
}

TEST(ClosestPoint, IsNoFartherThanAnySample) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 500; ++trial) {
    Triangle t{random_point(random), random_point(random), random_point(random)};
    if (trial % 10 == 0) t[2] = 0.3 * t[0] + 0.7 * t[1];  // without area
    const Vec3 p = 2.0 * random_point(random);
    const TrianglePoint q = closest_point(t, p);
    const double distance = (q.point - p).norm();
    EXPECT_NEAR(q.weights.sum(), 1.0, 1e-14);
    EXPECT_GE(q.weights.minCoeff(), 0.0);
    EXPECT_LT((q.point - q.weights[0] * t[0] - q.weights[1] * t[1] - q.weights[2] * t[2]).norm(),
              1e-14);
    double least = 1e300;
    constexpr int kSteps = 20;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const double a = double(i) / kSteps, b = double(j) / kSteps;
        least = std::min(least, (a * t[0] + b * t[1] + (1 - a - b) * t[2] - p).norm());
      }
    EXPECT_LE(distance, least + 1e-14);
    EXPECT_GE(distance, least - 2.0 * std::sqrt(3.0) / kSteps);  // the samples' spacing
  }
}

TEST(IntersectRay, FindsTheRightPlaceAndMissesOutside) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-0.5, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    const Triangle t{random_point(random), random_point(random), random_point(random)};
    const Vec3 origin = 2.0 * random_point(random);
    const double a = uniform(random), b = uniform(random);
    const Vec3 target = a * t[0] + b * t[1] + (1 - a - b) * t[2];
    const auto hit = intersect_ray(t, origin, (target - origin).normalized());
    const bool is_inside = a > 0 && b > 0 && a + b < 1;
    ASSERT_EQ(hit.has_value(), is_inside) << "trial " << trial;
    // Conditioning of grazing rays: 1e-8 is 1e-16 over the smallest sine met here.
    if (hit) {
      EXPECT_NEAR(hit->t, (target - origin).norm(), 1e-8);
    }
    EXPECT_FALSE(intersect_ray(t, origin, -(target - origin).normalized()).has_value() &&
                 is_inside);
  }
}

TEST(Predicates, AreExactWhereRoundingIsNot) {
  // d lies in the plane of a, b, c up to one unit in the last place.
  const Vec3 a(0.1, 0.1, 0.1), b(0.7, 0.1, 0.1), c(0.1, 0.9, 0.1);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.3, 0.3, 0.1)), 0);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.3, 0.3, std::nextafter(0.1, 1.0))), 1);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.3, 0.3, std::nextafter(0.1, 0.0))), -1);
  EXPECT_TRUE(is_degenerate({a, b, Vec3(0.3, 0.1, 0.1)}));
  EXPECT_FALSE(is_degenerate({a, b, Vec3(0.3, 0.1, std::nextafter(0.1, 1.0))}));
  EXPECT_TRUE(contains({a, b, c}, Vec3(0.3, 0.3, 0.1)));
  EXPECT_TRUE(contains({a, b, c}, b));
  EXPECT_FALSE(contains({a, b, c}, Vec3(0.3, 0.3, std::nextafter(0.1, 1.0))));
  EXPECT_FALSE(contains({a, b, c}, Vec3(0.7, 0.9, 0.1)));
}

TEST(Predicates, TellTouchingFromMissing) {
  const Triangle t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto shifted = [&](const Vec3& by) { return Triangle{t[0] + by, t[1] + by, t[2] + by}; };
  EXPECT_TRUE(do_intersect(t, shifted(Vec3(0.2, 0.2, 0.0))));   // overlap in the plane
  EXPECT_TRUE(do_intersect(t, shifted(Vec3(1.0, 0.0, 0.0))));   // corner to corner
  EXPECT_FALSE(do_intersect(t, shifted(Vec3(0.6, 0.6, 0.0))));  // in the plane, apart
  EXPECT_FALSE(do_intersect(t, shifted(Vec3(0.0, 0.0, 1e-300))));
  EXPECT_TRUE(do_intersect(t, Vec3(0.2, 0.2, -1.0), Vec3(0.2, 0.2, 1.0)));
  EXPECT_TRUE(do_intersect(t, Vec3(0.2, 0.2, -1.0), Vec3(0.2, 0.2, 0.0)));
  EXPECT_FALSE(do_intersect(t, Vec3(0.7, 0.7, -1.0), Vec3(0.7, 0.7, 1.0)));
  EXPECT_TRUE(is_folded(t[0], t[1], t[2], Vec3(0.5, 2.0, 0.0)));
  EXPECT_FALSE(is_folded(t[0], t[1], t[2], Vec3(0.5, -2.0, 0.0)));
  EXPECT_FALSE(is_folded(t[0], t[1], t[2], Vec3(0.5, 2.0, 1e-300)));
}

}  // namespace
}  // namespace meniscus
