#include "meniscus/topology/necks.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/surface/remesh.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus {
namespace {

using test::wavy_thread;

constexpr double kC0 = 9.0;

std::vector<Neck> necks_of(const SurfaceMesh& mesh, double radius,
                           const SurfaceMotion& motion = {}) {
  return find_necks(mesh, SurfaceTree(mesh), Side::inside, radius, motion);
}

// r = 0.5 √(1 − ξ⁴)(1 − 0.9 cos πξ): thinnest at x = 0, r = 0.05.
SurfaceMesh dumbbell() { return wavy_thread(2.0, 0.5, 4, -0.9, 1, kC0); }

TEST(Necks, AreFoundAtTheThinnestSectionOfADumbbell) {
  const auto necks = necks_of(dumbbell(), 0.06);
  ASSERT_EQ(necks.size(), 1U);
  // A ring of n edges has a perimeter less by π²/6n²; the remesh leaves ten edges or so: 1.6 %.
  EXPECT_NEAR(necks[0].radius, 0.05, 0.026 * 0.05);
  EXPECT_NEAR(std::abs(necks[0].axis.x()), 1.0, 0.01);
  EXPECT_NEAR(necks[0].center.norm(), 0.0, 0.05 * 0.5);
}

TEST(Section, EnclosesTheSmoothSurfacesAreaWithFewVertices) {
  const SurfaceMesh mesh = sphere(60);
  const SmoothSurface smooth(mesh, SurfaceTopology(mesh));
  const SurfaceTree tree(mesh);
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(1, 2, 3), Vec3(-2, 1, 0.3)}) {
    const SectionResult cut = section_around(mesh, tree, Vec3::Zero(), axis.normalized(), 2.0);
    ASSERT_EQ(cut.kind, SectionKind::closed);
    const double circle = std::numbers::pi;
    EXPECT_LT(cut.section.area, 0.96 * circle);
    EXPECT_NEAR(smooth_area(cut.section, mesh, smooth), circle, 2e-3 * circle);
  }
}

TEST(Necks, AreLeftAloneAboveTheLimit) { EXPECT_TRUE(necks_of(dumbbell(), 0.045).empty()); }

TEST(Necks, AreLeftAloneWhileTheyWiden) {
  const SurfaceMesh mesh = dumbbell();
  const auto moving = [&](double sign) {
    SurfaceMotion motion;
    VertexField<Vec3> v(mesh.num_vertices());
    for (const VertexId i : v.ids()) v[i] = sign * Vec3(0, mesh.x[i].y(), mesh.x[i].z());
    motion.add(mesh, std::move(v));
    return motion;
  };
  EXPECT_TRUE(necks_of(mesh, 0.06, moving(1.0)).empty());
  const auto thinning = necks_of(mesh, 0.06, moving(-1.0));
  ASSERT_EQ(thinning.size(), 1U);
  EXPECT_NEAR(thinning[0].rate, -0.05, 0.1 * 0.05);
}

TEST(Necks, AreNoPointedEndsNoSmallSpheresNoSheets) {
  EXPECT_TRUE(necks_of(sphere(100, 0.02), 0.05).empty());
  for (const Vec3& axes : {Vec3(1.0, 0.04, 0.04), Vec3(1.0, 1.0, 0.08)}) {
    SurfaceMesh mesh = stretched_sphere(1500, axes);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(remesh(mesh, {}).ok);
    EXPECT_TRUE(necks_of(mesh, 0.09).empty());
  }
}

TEST(Necks, OfAWavyThreadAreFoundOneAndAll) {
  // Thinnest at ξ = 0 and ±2/3, where r = 0.04.
  const SurfaceMesh mesh = wavy_thread(4.0, 0.2, 24, -0.8, 3, kC0);
  const auto necks = necks_of(mesh, 0.05);
  ASSERT_EQ(necks.size(), 3U);
  // The remeshings that made the surface have moved it a little: its own vertices tell its radius.
  for (const Neck& neck : necks) {
    double sum = 0.0;
    int count = 0;
    for (const Vec3& x : mesh.x) {
      if (std::abs(x.x() - neck.center.x()) > 0.3 * neck.radius) continue;
      sum += std::hypot(x.y(), x.z());
      ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_NEAR(neck.radius, sum / count, 0.03 * neck.radius);
    EXPECT_NEAR(neck.radius, 0.04, 0.1 * 0.04);
  }
}

TEST(Necks, DoNotDependOnTheNumberingOfVertices) {
  const SurfaceMesh mesh = wavy_thread(4.0, 0.2, 24, -0.8, 3, kC0);
  const auto necks = necks_of(mesh, 0.05);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto others = necks_of(test::shuffled(mesh, seed), 0.05);
    ASSERT_EQ(others.size(), necks.size()) << "seed " << seed;
    for (const Neck& neck : necks) {
      double nearest = 1e300;
      for (const Neck& other : others)
        nearest = std::min(
            nearest, (other.center - neck.center).norm() + std::abs(other.radius - neck.radius));
      EXPECT_LT(nearest, 1e-9) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace meniscus
