#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/volume/scenes.hpp"

namespace meniscus::test {

inline constexpr double kLargest = 1.2, kClearance = 0.1;  // radii, and what keeps drops apart

inline Vec3 random_point(std::mt19937& random, double half_width) {
  std::uniform_real_distribution<double> coordinate(-half_width, half_width);
  const double x = coordinate(random), y = coordinate(random);
  return {x, y, coordinate(random)};
}

/// Random places at which balls of the largest radius keep clear of each other.
inline std::vector<Vec3> centers(int count, double half_width, std::mt19937& random) {
  std::vector<Vec3> result;
  while (result.size() < static_cast<std::size_t>(count)) {
    const Vec3 x = random_point(random, half_width - kLargest - kClearance);
    const bool is_clear = std::ranges::all_of(result, [&](const Vec3& other) {
      return (x - other).norm() > 2.0 * kLargest + kClearance;
    });
    if (is_clear) result.push_back(x);
  }
  return result;
}

/// Drops of radius 0.8 to 1.2 at random places in a cube, of which they take `fraction`; the seed
/// is fixed.
inline Scene suspension(int drops, int drop_vertices, double fraction) {
  const double half_width = 0.5 * std::cbrt(drops * 4.0 / 3.0 * std::numbers::pi / fraction);
  std::mt19937 random(7);
  Scene scene = scene_within(
      box(static_cast<int>(6.0 * half_width * half_width), Vec3::Constant(half_width)).mesh);
  std::uniform_real_distribution<double> radius(0.8, kLargest);
  const SurfaceMesh unit_sphere = sphere(drop_vertices);
  for (const Vec3& center : centers(drops, half_width, random)) {
    const double size = radius(random);
    SurfaceMesh drop = unit_sphere;
    for (Vec3& x : drop.x) x = center + size * x;
    add_drop(scene, std::move(drop));
  }
  return scene;
}

/// Points in the liquids as a volume mesh has them: `per_drop` about each drop, denser towards its
/// surface, on either side.
inline std::vector<Vec3> points_around_drops(const Scene& scene, int per_drop) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (const Interface& interface : scene.interfaces) {
    const Vec3& a = interface.mesh.x[VertexId{0}];
    Vec3 center = Vec3::Zero();
    for (const Vec3& x : interface.mesh.x) center += x / interface.mesh.num_vertices();
    for (int i = 0; i < per_drop; ++i) {
      const double x = normal(random), y = normal(random);
      const Vec3 direction = Vec3(x, y, normal(random)).normalized();
      points.push_back(center + (a - center).norm() * (1.0 + 0.4 * normal(random)) * direction);
    }
  }
  // No point beyond the outer boundary, a box about the origin.
  const double half_width = scene.boundary.mesh.x[VertexId{0}].cwiseAbs().maxCoeff();
  for (Vec3& x : points) x = x.cwiseMax(-0.99 * half_width).cwiseMin(0.99 * half_width);
  return points;
}

}  // namespace meniscus::test
