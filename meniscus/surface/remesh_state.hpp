#pragma once

#include "meniscus/surface/edit_mesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"
#include "meniscus/surface/surface_walk.hpp"
#include "meniscus/surface/vertex_set.hpp"

namespace meniscus {

/// What stays fixed during one remesh: the surface as it came, and the lengths it asks for.
struct RemeshReference {
  struct Corner {
    Vec3 n;              ///< unit normal of the smooth surface
    double rest_length;  ///< [R0]
    Vec3 slope;          ///< gradient of the rest length along the surface
  };
  SmoothSurface surface;
  SurfaceWalk walk;
  VertexField<Corner> corners;  ///< at the vertices of the surface as it came
};

/// A vertex of the mesh being rebuilt. What springs and flips read most comes first.
struct RemeshVertex {
  Vec3 x;              ///< near the smooth surface; on it after `lift_to_surface`
  double rest_length;  ///< l0 there
  Vec3 n;              ///< its unit normal there, interpolated linearly
  SurfacePoint point;
};

/// A triangulation under way from the old to the new one. Most of it comes to rest early: flips and
/// springs look only at what has changed since they last did.
struct RemeshState {
  const RemeshReference& reference;
  EditMesh mesh;
  VertexField<RemeshVertex> vertices;
  VertexSet unflipped = {};  ///< around these an edge may be due to flip
  VertexSet unrelaxed = {};  ///< these and their neighbours may be pulled

  /// Marks a vertex that has moved or whose edges have changed.
  void touch(VertexId v) {
    unflipped.insert(v);
    unrelaxed.insert(v);
  }

  [[nodiscard]] Vec3 edge_vector(HalfedgeId h) const {
    return vertices[mesh.to(h)].x - vertices[mesh.from(h)].x;
  }
  [[nodiscard]] double rest_length(HalfedgeId h) const {
    return 0.5 * (vertices[mesh.from(h)].rest_length + vertices[mesh.to(h)].rest_length);
  }
};

[[nodiscard]] RemeshState start_state(const RemeshReference& reference, const SurfaceMesh& mesh,
                                      const SurfaceTopology& topology);
/// The vertex at a point y = Σ b_k x_k of the reference surface. It is moved half of the way to the
/// tangent planes at the corners, ½ Σ b_k (n_k·(x_k − y)) n_k. It lies on the smooth surface where
/// the curvature is even, otherwise O(h³) away. It costs a fifth. Its rest length is Σ b_k (l0_k +
/// ½ ∇l0_k·(y − x_k)), likewise O(h³).
[[nodiscard]] RemeshVertex vertex_at(const RemeshReference& reference, const SurfacePoint& point);
/// Puts all vertices on the smooth surface.
void lift_to_surface(RemeshState& state);
/// Puts all vertices on splines (`SplinePatch`) through the vertices of the surface as it came.
void lift_to_splines(RemeshState& state, const SurfaceMesh& mesh, const SurfaceTopology& topology);
/// The vertex half-way between two on the reference surface.
[[nodiscard]] RemeshVertex halfway(const RemeshReference& reference, const RemeshVertex& a,
                                   const RemeshVertex& b);
/// Whether the triangle of three points faces the way of the surface at its corners.
[[nodiscard]] bool is_consistently_oriented(const RemeshVertex& a, const RemeshVertex& b,
                                            const RemeshVertex& c);

}  // namespace meniscus
