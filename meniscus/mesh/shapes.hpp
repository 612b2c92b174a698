#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Sphere with exactly `num_vertices` ≥ 12 vertices on it. It is a spiral point set, relaxed by
/// Lloyd sweeps on the sphere, triangulated by its convex hull. Valence is 5–7 nearly everywhere.
[[nodiscard]] SurfaceMesh sphere(int num_vertices, double radius = 1.0,
                                 const Vec3& center = Vec3::Zero());
/// The sphere under the linear map diag(axes): vertex density of the sphere, not of curvature.
[[nodiscard]] SurfaceMesh stretched_sphere(int num_vertices, const Vec3& axes,
                                           const Vec3& center = Vec3::Zero());
/// Axis-aligned box [−a, a]³ with about `num_vertices` vertices, structured; face_side[f] = 0…5 for
/// the sides −x, +x, −y, +y, −z, +z.
struct TaggedSurface {
  SurfaceMesh mesh;
  FaceField<int> tag;
};
[[nodiscard]] TaggedSurface box(int num_vertices, const Vec3& half_widths);
/// Cylinder about the x-axis with flat ends; tag 0: side, 1: end at −x, 2: end at +x.
[[nodiscard]] TaggedSurface cylinder(int num_vertices, double radius, double half_length);

}  // namespace meniscus
