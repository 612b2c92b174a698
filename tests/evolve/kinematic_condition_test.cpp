#include "meniscus/evolve/kinematic_condition.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {
namespace {

template <class Velocity>
MiddleNodes middle_nodes(const SurfaceMesh& mesh, Velocity&& velocity) {
  const SurfaceTopology topology(mesh);
  const std::vector<Vec3> middles = middles_on_splines(mesh, topology);
  MiddleNodes nodes;
  for (const std::array<std::size_t, 3>& edges : face_edges(mesh, topology)) {
    const std::array<Vec3, 3> x = {middles[edges[0]], middles[edges[1]], middles[edges[2]]};
    nodes.x.add(x);
    nodes.v.add({velocity(x[0]), velocity(x[1]), velocity(x[2])});
  }
  return nodes;
}

template <class Velocity>
VertexField<Vec3> vertex_values(const SurfaceMesh& mesh, Velocity&& velocity) {
  VertexField<Vec3> v;
  for (const Vec3& x : mesh.x) v.add(velocity(x));
  return v;
}

VertexField<Vec3> smooth_normals(const SurfaceMesh& mesh) {
  return SmoothSurface(mesh, SurfaceTopology(mesh)).vertex_normals();
}

/// Root mean squares of n·v over the vertices, before and after the correction.
struct Speeds {
  double at_points = 0.0, in_the_mean = 0.0;
};
template <class Velocity>
Speeds rms_speeds(const SurfaceMesh& mesh, Velocity&& velocity) {
  const VertexField<Vec3> n = smooth_normals(mesh);
  VertexField<Vec3> v = vertex_values(mesh, velocity);
  const auto rms = [&] {
    double sum = 0.0;
    for (const VertexId i : v.ids()) sum += n[i].dot(v[i]) * n[i].dot(v[i]);
    return std::sqrt(sum / v.size());
  };
  Speeds speeds{.at_points = rms()};
  follow_faces(mesh, n, middle_nodes(mesh, velocity), v);
  speeds.in_the_mean = rms();
  return speeds;
}

TEST(KinematicCondition, ATranslationIsLeftAsItIs) {
  const SurfaceMesh mesh = stretched_sphere(150, Vec3(1.6, 0.7, 0.9));
  const auto velocity = [](const Vec3&) { return Vec3(0.3, -1.0, 0.2); };
  VertexField<Vec3> v = vertex_values(mesh, velocity);
  follow_faces(mesh, smooth_normals(mesh), middle_nodes(mesh, velocity), v);
  for (const Vec3& each : v) EXPECT_LT((each - velocity(each)).norm(), 1e-13);
}

// u = S(Ω × S⁻¹x) goes round on the ellipsoid |S⁻¹x| = 1, so that n·u = 0 on it.
TEST(KinematicCondition, AShapeStandsThoughItsLiquidGoesRound) {
  const Vec3 axes(1.5, 0.75, 0.9), spin(0.3, 0.2, -0.9);
  const auto velocity = [&](const Vec3& x) -> Vec3 {
    return axes.cwiseProduct(spin.cross(x.cwiseQuotient(axes)));
  };
  const Speeds coarse = rms_speeds(stretched_sphere(200, axes), velocity),
               fine = rms_speeds(stretched_sphere(800, axes), velocity);
  EXPECT_LT(coarse.in_the_mean, 0.5 * coarse.at_points);
  EXPECT_LT(fine.in_the_mean, 0.5 * fine.at_points);
  EXPECT_GT(std::log2(coarse.in_the_mean / fine.in_the_mean), 3.0);  // per halving of the edges
}

// A linear flow's normal speed on a sphere is known at every point: the correction adds less than
// 2e-3 of it on 110 vertices, and falls with h⁴.
TEST(KinematicCondition, NormalSpeedsOnASphereAreKept) {
  const auto velocity = [](const Vec3& x) { return Vec3(x.x(), -0.5 * x.y(), -0.5 * x.z()); };
  const auto largest = [&](int n) {
    const SurfaceMesh mesh = sphere(n);
    const VertexField<Vec3> before = vertex_values(mesh, velocity);
    VertexField<Vec3> v = before;
    follow_faces(mesh, mesh.x, middle_nodes(mesh, velocity), v);
    double most = 0.0;
    for (const VertexId i : v.ids()) most = std::max(most, (v[i] - before[i]).norm());
    return most;
  };
  EXPECT_LT(largest(110), 2e-3);
  EXPECT_LT(largest(440), largest(110) / 8.0);
}

}  // namespace
}  // namespace meniscus
