#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus::test {

/// The octahedron of corners ±e_k, faces outward.
inline SurfaceMesh octahedron() {
  SurfaceMesh mesh;
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) mesh.x.add(sign * Vec3::Unit(k));
  for (const int x : {0, 1})
    for (const int y : {2, 3})
      for (const int z : {4, 5}) {
        const bool is_left_handed = (x + y + z) % 2 == 1;
        mesh.faces.add(
            {VertexId{x}, VertexId{is_left_handed ? z : y}, VertexId{is_left_handed ? y : z}});
      }
  return mesh;
}

}  // namespace meniscus::test
