#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// A change of scale about a point: x ↦ c + s (x − c), s > 0.
struct Dilation {
  Vec3 center = Vec3::Zero();  ///< c [R0]
  double factor = 1.0;         ///< s

  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return center + factor * (x - center); }
};

[[nodiscard]] inline SurfaceMesh scaled(SurfaceMesh mesh, const Dilation& dilation) {
  for (Vec3& x : mesh.x) x = dilation(x);
  return mesh;
}

}  // namespace meniscus
