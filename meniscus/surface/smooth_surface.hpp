#pragma once

#include "meniscus/core/share_numbers.hpp"
#include "meniscus/surface/dilation.hpp"
#include "meniscus/surface/height_patch.hpp"

namespace meniscus {

/// A point of a triangulated surface.
struct SurfacePoint {
  FaceId face;
  Vec3 weights = Vec3::Zero();  ///< barycentric: non-negative, sum 1
};

/// The smooth surface that a triangulation stands for. Around each vertex it is a cubic patch,
/// fitted to two unrolled rings in the frame of the osculating fit's normal. Over a face it blends
/// the three patches of its corners.
///
///   S(b) = y + Σ_k w_k(b) (z_k(u, v) − n_k·(y − x_k)) n_k,   y = Σ b_k x_k,   w_k = b_k²/Σ b_j²
///
/// where (u, v) are the coordinates of the flat point y in the frame of patch k. It passes through
/// every vertex with the tangent plane of the vertex's patch. Over an edge it depends on the
/// patches of the two ends alone, so that faces join without gaps. Position error O(h⁴), normal
/// O(h³), a patch's curvature at its vertex O(h²) on smooth surfaces; a sphere to O(h⁶). Patches
/// fall back to lower degree where fewer than two rings can be seen (filaments as thin as an edge,
/// solids of few vertices). So do those that swing away from the edges at their vertex (crumpled
/// surfaces). A value: it keeps what it needs of the mesh.
class SmoothSurface {
 public:
  SmoothSurface(const SurfaceMesh& mesh, const SurfaceTopology& topology)
      : SmoothSurface(mesh, topology, own_numbers) {}
  /// Shares out the fits at the vertices.
  SmoothSurface(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                const ShareNumbers& share);

  struct PointNormal {
    Vec3 x;  ///< S(b) [R0]
    Vec3 n;  ///< unit; blended from the normals of the patches, continuous across edges
  };
  [[nodiscard]] PointNormal at(const SurfacePoint& location) const;
  [[nodiscard]] Vec3 point(const SurfacePoint& location) const;
  [[nodiscard]] Vec3 point(FaceId f, const Vec3& weights) const { return point({f, weights}); }
  [[nodiscard]] Vec3 normal(FaceId f, const Vec3& weights) const { return at({f, weights}).n; }
  /// n at a vertex, unit.
  [[nodiscard]] const Vec3& vertex_normal(VertexId v) const { return normals_[v]; }
  [[nodiscard]] const VertexField<Vec3>& vertex_normals() const { return normals_; }
  /// S over the edge from a (s = 0) to b (s = 1): the same point as from either face.
  [[nodiscard]] Vec3 edge_point(VertexId a, VertexId b, double s) const;

  /// The osculating fit at the vertices.
  [[nodiscard]] const VertexField<VertexCurvature>& vertex_curvature() const { return curvature_; }
  [[nodiscard]] const HeightPatch& patch(VertexId v) const { return patches_[v]; }
  [[nodiscard]] const FaceVertices& corners(FaceId f) const { return faces_[f]; }
  [[nodiscard]] std::int32_t num_vertices() const { return patches_.size(); }

  /// The surface of the scaled vertices, the same to round-off as one fitted to them.
  [[nodiscard]] SmoothSurface scaled(const Dilation& dilation) const;

 private:
  /// The point y = Σ b_k x_k of the flat face.
  [[nodiscard]] Vec3 flat_point(const SurfacePoint& location) const;

  VertexField<VertexCurvature> curvature_;
  VertexField<HeightPatch> patches_;
  VertexField<Vec3> normals_;  // of the patches at their vertices
  FaceField<FaceVertices> faces_;
};

}  // namespace meniscus
