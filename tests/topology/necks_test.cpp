#include "meniscus/topology/necks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/topology/cut_off.hpp"
#include "meniscus/topology/thread_search.hpp"
#include "tests/surface/shapes.hpp"
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

TEST(CutOff, IsTheCapOfASphere) {
  const SurfaceMesh mesh = sphere(4000);
  const SurfaceTree tree(mesh);
  const FaceNeighbours neighbours = face_neighbours(mesh, SurfaceTopology(mesh));
  const double whole = enclosed_volume(mesh);
  for (const double h : {-0.6, -0.1, 0.0, 0.5, 0.9}) {
    const Vec3 axis = Vec3(1, 2, -2) / 3.0;
    const SectionResult cut = section_around(mesh, tree, h * axis, axis, 3.0);
    ASSERT_EQ(cut.kind, SectionKind::closed);
    const CutOff above = cut_off(mesh, neighbours, cut.section, 1.0),
                 below = cut_off(mesh, neighbours, cut.section, -1.0);
    const double cap = std::numbers::pi * std::pow(1.0 - h, 2) * (2.0 + h) / 3.0;
    EXPECT_NEAR(above.volume, cap, 3e-3 * std::sqrt(cap));
    EXPECT_NEAR(above.volume + below.volume, whole, 1e-13);
    EXPECT_NEAR(above.reach, 1.0 - h, 2e-3);
    EXPECT_NEAR(below.reach, 1.0 + h, 2e-3);
  }
}

TEST(CutOff, OfATorusComesRound) {
  const SurfaceMesh mesh = test::torus(60, 24, 1.0, 0.3);
  const SectionResult cut =
      section_around(mesh, SurfaceTree(mesh), Vec3(1, 0, 0), Vec3(0, 1, 0), 0.6);
  ASSERT_EQ(cut.kind, SectionKind::closed);
  const FaceNeighbours neighbours = face_neighbours(mesh, SurfaceTopology(mesh));
  for (const double side : {1.0, -1.0})
    EXPECT_TRUE(std::isinf(cut_off(mesh, neighbours, cut.section, side).volume));
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
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(remesh(mesh, {}).ok());
    EXPECT_TRUE(necks_of(mesh, 0.09).empty());
  }
}

// A unit sphere with a knob of the given height (a dent, where negative) beyond a neck of radius
// 0.04, 0.03 off the sphere; it widens to 0.05 half-way.
SurfaceMesh knobbed_sphere(double height) {
  constexpr int kAround = 24, kAlong = 60, kDown = 40;
  std::vector<Vec3> profile;  // (r, 0, z), from the pole opposite the dent to its bottom
  const double rim = 0.07, top = std::sqrt(1.0 - rim * rim),
               mouth = top + std::copysign(0.03, height);
  for (int i = 0; i <= kAlong; ++i) {
    const double angle =
        std::numbers::pi * (1.0 - (1.0 - std::asin(rim) / std::numbers::pi) * i / kAlong);
    profile.emplace_back(std::sin(angle), 0.0, std::cos(angle));
  }
  for (int i = 1; i <= 6; ++i) {
    const double s = i / 6.0;
    profile.emplace_back(rim - (rim - 0.04) * s * (2.0 - s), 0.0, top + (mouth - top) * s);
  }
  for (int i = 1; i <= kDown; ++i) {
    const double s = static_cast<double>(i) / kDown, widening = 0.04 + 0.04 * s * (1.0 - s);
    profile.emplace_back(widening * std::sqrt(1.0 - std::pow(s, 8)), 0.0, mouth + height * s);
  }
  SurfaceMesh mesh;
  const VertexId first = mesh.x.add(profile.front());
  std::vector<VertexId> ring(kAround, first);
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const bool is_last = i + 1 == profile.size();
    std::vector<VertexId> next;
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      next.push_back(is_last && k > 0
                         ? next.front()
                         : mesh.x.add({profile[i].x() * std::cos(angle),
                                       profile[i].x() * std::sin(angle), profile[i].z()}));
    }
    for (std::size_t k = 0; k < next.size(); ++k) {
      const std::size_t l = (k + 1) % next.size();
      if (i > 1) mesh.faces.add({ring[k], ring[l], next[k]});
      if (!is_last) mesh.faces.add({ring[l], next[l], next[k]});
    }
    ring = std::move(next);
  }
  return mesh;
}

// A knob of height 0.065 reaches 1.6 radii from its neck, but holds less than 7π/3 radii cubed.
TEST(Necks, AreNoneBelowKnobsAndDentsThatHoldLittle) {
  for (const auto& [height, num_necks] : {std::pair(0.05, 0U), {0.065, 0U}, {0.12, 1U}})
    for (const Side side : {Side::inside, Side::outside}) {
      const SurfaceMesh mesh = knobbed_sphere(side == Side::inside ? height : -height);
      ASSERT_EQ(text_of(find_defect(mesh)), "");
      ASSERT_NEAR(enclosed_volume(mesh), 4.0 / 3.0 * std::numbers::pi, 0.1);
      const auto necks = find_necks(mesh, SurfaceTree(mesh), side, 0.045, {});
      EXPECT_EQ(necks.size(), num_necks) << "knob of height " << height;
    }
}

// No section of the flat drops is as narrow as the widest that is followed: neither of the thick
// one nor of the sheet. A place tried costs as much as there are faces around it.
TEST(Necks, OfFlatDropsAreSoughtFromAsManyPlacesOnFineMeshes) {
  for (const Vec3& axes : {Vec3(1.3, 1.3, 0.59), Vec3(2.0, 2.0, 0.25)}) {
    const auto num_tried = [&](int vertices) {
      const SurfaceMesh mesh = stretched_sphere(vertices, axes);
      const FoundThreads found = find_threads(mesh, SurfaceTree(mesh), Side::inside, 0.75);
      EXPECT_TRUE(found.threads.empty());
      return found.num_tried;
    };
    // Four times as many where every vertex is tried; on the coarser sheet vertices are as far
    // apart as places that answer for each other.
    EXPECT_LT(num_tried(12000), 2.0 * num_tried(3000)) << axes.z();
  }
}

TEST(Necks, OfAThinPlatesHoleAreFound) {
  // 0.08 thick, with round rims; its hole has the radius 0.04.
  SurfaceMesh mesh = test::torus(48, 24, 0.6, 0.04);
  for (Vec3& x : mesh.x) {
    const double rho = std::hypot(x.x(), x.y()), from_middle = rho - 0.6;
    const double moved =
        rho + std::copysign(0.52 * std::min(1.0, std::abs(from_middle) / 0.02), from_middle);
    x = Vec3(moved / rho * x.x(), moved / rho * x.y(), x.z());
  }
  const auto necks = find_necks(mesh, SurfaceTree(mesh), Side::outside, 0.045, {});
  ASSERT_EQ(necks.size(), 1U);
  EXPECT_NEAR(necks[0].radius, 0.04, 0.02 * 0.04);
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
