#pragma once

#include <random>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::test {

/// Scenes for the tests of the volume room: drops are added from the outermost in.
inline Scene scene_within(SurfaceMesh boundary) {
  Scene scene;
  scene.boundary.patch = FaceField<PatchId>(boundary.num_faces(), PatchId{0});
  scene.boundary.patches.add({"wall", NoPenetration{}});
  scene.boundary.mesh = std::move(boundary);
  scene.liquids.add({});
  return scene;
}

inline void add_drop(Scene& scene, SurfaceMesh surface, RegionId outside = RegionId{0}) {
  Interface drop;
  drop.drop = static_cast<int>(scene.interfaces.size());
  drop.inside = RegionId{drop.drop + 1};
  drop.outside = outside;
  drop.mesh = std::move(surface);
  scene.interfaces.push_back(std::move(drop));
  scene.liquids.add({});
}

inline Scene drop_in_sphere(int drop_vertices, double radius, int boundary_vertices) {
  Scene scene = scene_within(sphere(boundary_vertices, radius));
  add_drop(scene, sphere(drop_vertices));
  return scene;
}

/// Two bulbs joined by a neck of a fifth of their radius, about the x-axis; not star-shaped.
inline SurfaceMesh dumbbell(int vertices) {
  SurfaceMesh mesh = sphere(vertices);
  for (Vec3& x : mesh.x) {
    const double neck = 1.0 - 0.8 * std::exp(-std::pow(x.x() / 0.4, 4));
    x = Vec3(3.0 * x.x(), neck * x.y(), neck * x.z());
  }
  return mesh;
}

inline Mat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Mat3 rotation;
  Vec3 a(normal(random), normal(random), normal(random)),
      b(normal(random), normal(random), normal(random));
  a.normalize();
  b = (b - b.dot(a) * a).normalized();
  rotation.col(0) = a;
  rotation.col(1) = b;
  rotation.col(2) = Vec3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                         a.x() * b.y() - a.y() * b.x());
  return rotation;
}

/// A sphere under a random linear map of singular values 0.6 … 1.4, somewhat off the given centre.
inline SurfaceMesh random_ellipsoid(std::mt19937& random, int vertices, const Vec3& center,
                                    double scale = 1.0) {
  std::uniform_real_distribution<double> stretch(0.6, 1.4), shift(-0.1, 0.1);
  const Mat3 map = scale * random_rotation(random) *
                   Vec3(stretch(random), stretch(random), stretch(random)).asDiagonal();
  const Vec3 origin = center + scale * Vec3(shift(random), shift(random), shift(random));
  SurfaceMesh mesh = sphere(vertices);
  for (Vec3& x : mesh.x) x = origin + map * x;
  return mesh;
}

}  // namespace meniscus::test
