#include "meniscus/surface/gap.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

VertexField<Vec3> normals(const SurfaceMesh& mesh) {
  VertexField<Vec3> result = vertex_area_vectors(mesh);
  for (Vec3& n : result) n.normalize();
  return result;
}

VertexField<double> bounded(const SurfaceMesh& mesh, double length,
                            const std::vector<const SurfaceTree*>& neighbours) {
  VertexField<double> lengths(mesh.num_vertices(), length);
  bound_by_gaps(lengths, mesh, normals(mesh), 3.0, neighbours);
  return lengths;
}

/// A disc, an ellipsoid of half-axes 2, 1 and 0.1: its thickness above the point (x, y), and
/// whether that is so far from the rim that rays along the normals are steep to within 4°.
constexpr double kThin = 0.1;
SurfaceMesh disc() { return stretched_sphere(2000, Vec3(2, 1, kThin)); }
double squared_fraction(const Vec3& x) { return x.x() * x.x() / 4.0 + x.y() * x.y(); }
double thickness(const Vec3& x) { return 2.0 * kThin * std::sqrt(1.0 - squared_fraction(x)); }
bool is_far_from_rim(const Vec3& x) { return squared_fraction(x) < 0.25; }

TEST(OwnGaps, AreMetAlongTheNormalWithinReach) {
  const SurfaceMesh mesh = disc();
  const SurfaceTree tree(mesh);
  const auto gaps_within = [&](double reach) {
    return own_gaps(mesh, tree, normals(mesh), VertexField<double>(mesh.num_vertices(), reach));
  };
  const OwnGaps gaps = gaps_within(0.5), none = gaps_within(0.1);
  for (const VertexId v : mesh.x.ids()) {
    EXPECT_TRUE(std::isinf(gaps.outside[v]));  // convex
    if (!is_far_from_rim(mesh.x[v])) continue;
    EXPECT_NEAR(gaps.inside[v], thickness(mesh.x[v]), 0.02 * thickness(mesh.x[v]));
    EXPECT_TRUE(std::isinf(none.inside[v]));
  }
}

TEST(BoundByGaps, ThinDropIsBoundByItsThickness) {
  const SurfaceMesh mesh = disc();
  const auto lengths = bounded(mesh, 0.3, {});
  for (const VertexId v : mesh.x.ids()) {
    if (!is_far_from_rim(mesh.x[v])) continue;
    const double bound = kGapEdge * thickness(mesh.x[v]) / 3.0;
    EXPECT_NEAR(lengths[v], bound, 0.02 * bound);
  }
  for (const double l : bounded(sphere(500), 0.1, {})) EXPECT_EQ(l, 0.1);
}

TEST(BoundByGaps, NeighboursBindByDistanceAndTheirOwnEdges) {
  const SurfaceMesh mesh = sphere(1000);
  const SurfaceMesh fine = sphere(8000, 1.1), coarse = sphere(500, 1.1);
  const SurfaceTree fine_tree(fine), coarse_tree(coarse);
  for (const double l : bounded(mesh, 0.1, {&fine_tree}))
    EXPECT_NEAR(l, kGapEdge * 0.1 / 3.0, 0.02 * l);  // facets: 1.8/N of the radius
  // Half of an edge opposite: longer than the gap would have it, and nothing is ever lengthened.
  const double edge = mean_edge(coarse);
  for (const double l : bounded(mesh, 0.5, {&coarse_tree})) EXPECT_NEAR(l, 0.5 * edge, 0.15 * edge);
  for (const double l : bounded(mesh, 0.03, {&coarse_tree})) EXPECT_LE(l, 0.03);
  const SurfaceMesh far = sphere(500, 3.0);
  const SurfaceTree far_tree(far);
  for (const double l : bounded(mesh, 0.1, {&far_tree})) EXPECT_EQ(l, 0.1);
}

}  // namespace
}  // namespace meniscus
