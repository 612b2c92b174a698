#pragma once

#include "meniscus/surface/edit_mesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"
#include "meniscus/surface/surface_walk.hpp"

namespace meniscus {

/// What stays fixed during one remesh: the surface as it came, and the lengths it asks for.
struct RemeshReference {
  SmoothSurface surface;
  SurfaceWalk walk;
  VertexField<double> rest_length;  ///< at the vertices of the surface as it came [R0]
};

/// A vertex of the mesh being rebuilt: always a point of the reference surface.
struct RemeshVertex {
  SurfaceLocation place;
  Vec3 x, n;           ///< position and unit normal of the smooth surface there
  double rest_length;  ///< l0 there
};

/// A triangulation under way from the old to the new one.
struct RemeshState {
  const RemeshReference& reference;
  EditMesh mesh;
  VertexField<RemeshVertex> vertices;

  [[nodiscard]] Vec3 edge_vector(HalfedgeId h) const {
    return vertices[mesh.to(h)].x - vertices[mesh.from(h)].x;
  }
  [[nodiscard]] double rest_length(HalfedgeId h) const {
    return 0.5 * (vertices[mesh.from(h)].rest_length + vertices[mesh.to(h)].rest_length);
  }
};

[[nodiscard]] RemeshState start_state(const RemeshReference& reference, const SurfaceMesh& mesh,
                                      const SurfaceTopology& topology);
/// The vertex at a place of the reference surface.
[[nodiscard]] RemeshVertex vertex_at(const RemeshReference& reference,
                                     const SurfaceLocation& place);
/// The vertex half-way between two on the reference surface.
[[nodiscard]] RemeshVertex halfway(const RemeshReference& reference, const RemeshVertex& a,
                                   const RemeshVertex& b);
/// Whether the triangle of three points faces the way of the surface at its corners.
[[nodiscard]] bool is_upright(const RemeshVertex& a, const RemeshVertex& b, const RemeshVertex& c);

}  // namespace meniscus
