#pragma once

// For sources that call CGAL on a surface; no other header includes it.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// A surface for CGAL. Vertices and faces keep their order.
inline CgalMesh to_cgal(const SurfaceMesh& mesh) {
  CgalMesh result;
  for (const Vec3& x : mesh.x) result.add_vertex({x.x(), x.y(), x.z()});
  const auto corner = [](VertexId v) {
    return CgalMesh::Vertex_index(static_cast<std::uint32_t>(v.value));
  };
  for (const FaceVertices& f : mesh.faces)
    result.add_face(corner(f[0]), corner(f[1]), corner(f[2]));
  return result;
}

/// Removed elements are dropped first, so that ids run without gaps.
inline SurfaceMesh from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  SurfaceMesh result;
  for (const auto v : mesh.vertices()) {
    const CgalKernel::Point_3& x = mesh.point(v);
    result.x.add(Vec3(x.x(), x.y(), x.z()));
  }
  for (const auto f : mesh.faces()) {
    FaceVertices corners;
    std::size_t k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      corners[k++] = VertexId{static_cast<std::int32_t>(v.idx())};
    result.faces.add(corners);
  }
  return result;
}

}  // namespace meniscus
