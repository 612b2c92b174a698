#include "meniscus/mesh/contour.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

/// A function of place at the points of [−1.5, 1.5]³.
template <class F>
Lattice sampled(int points, const F& f) {
  Lattice lattice{Vec3::Constant(-1.5), 3.0 / (points - 1), {points, points, points}, {}};
  for (int k = 0; k < points; ++k)
    for (int j = 0; j < points; ++j)
      for (int i = 0; i < points; ++i) lattice.values.push_back(f(lattice.position(i, j, k)));
  return lattice;
}

TEST(Contour, OfTheDistanceFromAPointIsASphere) {
  const Lattice lattice = sampled(31, [](const Vec3& x) { return x.norm(); });
  const SurfaceMesh surface = contour(lattice, 1.0);
  EXPECT_EQ(text_of(find_defect(surface)), "");
  EXPECT_EQ(surface.num_vertices() - surface.num_faces() / 2, 2);
  // Chords lie h²/8R below, vertices within 0.05 of the longest lattice edge √3 h.
  const double h = lattice.spacing, off = 3.0 * h * h / 8.0 + 0.05 * std::sqrt(3.0) * h;
  for (const Vec3& x : surface.x) EXPECT_NEAR(x.norm(), 1.0, off);
  EXPECT_NEAR(enclosed_volume(surface), 4.0 / 3.0 * std::numbers::pi, off * 4.0 * std::numbers::pi);
}

TEST(Contour, OfPiecesAndHolesIsSoundWhereItPassesThroughLatticePoints) {
  // Levels that many lattice points have: |x|₁ and the rings of a torus of square section.
  const Lattice octahedron = sampled(13, [](const Vec3& x) { return x.lpNorm<1>(); });
  EXPECT_EQ(text_of(find_defect(contour(octahedron, 1.0))), "");
  const Lattice ring = sampled(13, [](const Vec3& x) {
    const double out = std::abs(x.head<2>().lpNorm<Eigen::Infinity>() - 0.75);
    return std::max(out, std::abs(x.z()));
  });
  const SurfaceMesh torus = contour(ring, 0.5);
  EXPECT_EQ(text_of(find_defect(torus)), "");
  EXPECT_EQ(torus.num_vertices() - torus.num_faces() / 2, 0);
  const Lattice two = sampled(31, [](const Vec3& x) {
    return std::min((x - Vec3(0.7, 0, 0)).norm(), (x + Vec3(0.7, 0, 0)).norm());
  });
  EXPECT_EQ(connected_pieces(contour(two, 0.5)).size(), 2U);
  EXPECT_EQ(contour(two, -1.0).num_faces(), 0);
}

}  // namespace
}  // namespace meniscus
