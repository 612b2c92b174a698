#pragma once

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/flow/bem/boundary_integral_flow.hpp"
#include "meniscus/flow/bem/interface_elements.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::bem::test {

/// Unbounded matrix of viscosity 1 with the imposed flow v = G·x; drops are added one by one.
inline Scene unbounded_scene(const Mat3& gradient) {
  Scene scene;
  scene.is_unbounded = true;
  scene.flow = ImposedFlow(FlowFamily::general, gradient);
  scene.liquids.add({});
  return scene;
}

inline void add_drop(Scene& scene, SurfaceMesh mesh, double viscosity, double tension,
                     RegionId outside = RegionId{0}) {
  Interface drop;
  drop.drop = static_cast<int>(scene.interfaces.size());
  drop.mesh = std::move(mesh);
  drop.inside = scene.liquids.add({.viscosity = viscosity});
  drop.outside = outside;
  drop.tension = tension;
  scene.interfaces.push_back(std::move(drop));
}

struct Solution {
  std::vector<VertexField<Vec3>> u;
  int iterations = 0;
};
inline Solution solved(const Scene& scene, const Options& options = {}) {
  FlowSolution solution = make_boundary_integral_flow(options)->solve({scene}, {});
  EXPECT_TRUE(solution.ok()) << solution.text();
  return {std::move(solution.velocity), solution.iterations};
}

/// Least-squares coefficient of n·u against a function on the sphere: the amplitude of its mode.
template <class Function>
double amplitude(const SurfaceMesh& sphere, const VertexField<Vec3>& normals,
                 const VertexField<Vec3>& u, Function&& mode) {
  double with_mode = 0.0, of_mode = 0.0;
  for (const VertexId v : u.ids()) {
    const double f = mode(sphere.x[v]);
    with_mode += normals[v].dot(u[v]) * f;
    of_mode += f * f;
  }
  return with_mode / of_mode;
}

inline double largest_difference(const VertexField<Vec3>& a, const VertexField<Vec3>& b) {
  double largest = 0.0;
  for (const VertexId v : a.ids()) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

inline double largest_norm(const VertexField<Vec3>& u) {
  double largest = 0.0;
  for (const Vec3& v : u) largest = std::max(largest, v.norm());
  return largest;
}

/// Any traceless gradient, with rotation.
inline Mat3 general_gradient() {
  Mat3 g;
  g << 0.3, 0.9, -0.2, 0.1, 0.4, 0.5, -0.6, 0.2, -0.7;
  return g;
}

inline Mat3 random_rotation(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

/// Order in h ~ N^(−1/2) between two errors.
inline double order(int coarse, double coarse_error, int fine, double fine_error) {
  return 2.0 * std::log(coarse_error / fine_error) /
         std::log(static_cast<double>(fine) / static_cast<double>(coarse));
}

}  // namespace meniscus::bem::test
