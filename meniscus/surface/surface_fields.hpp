#pragma once

#include <vector>

#include "meniscus/surface/smooth_surface.hpp"
#include "meniscus/surface/surface_walk.hpp"

namespace meniscus {

enum class FieldTransfer {
  interpolated,  ///< values where the new vertices and faces lie
  conserved      ///< and then ∮ dS of each piece of the surface as it was, to round-off
};

/// Values on a surface that follow when it is remeshed. On vertices they are linear over the faces,
/// so that their integral is Σ_v value · (a third of the area of the faces at v); on faces they are
/// means. The order of the lists is kept.
struct SurfaceFields {
  struct OnVertices {
    VertexField<double> values;
    FieldTransfer transfer = FieldTransfer::interpolated;
  };
  struct OnFaces {
    FaceField<double> values;
    FieldTransfer transfer = FieldTransfer::interpolated;
  };
  std::vector<OnVertices> on_vertices;
  std::vector<OnFaces> on_faces;

  [[nodiscard]] bool empty() const { return on_vertices.empty() && on_faces.empty(); }
};

/// The surface that fields come from, and where on it the vertices of the new mesh lie.
struct SurfaceChange {
  const SurfaceMesh& before;
  const SurfaceTopology& topology;  ///< of `before`
  const SmoothSurface& surface;     ///< of `before`
  const SurfaceWalk& walk;          ///< on `before`
  const SurfaceMesh& after;
  const VertexField<SurfaceLocation>& places;  ///< on `before`, of the vertices of `after`
};

/// Carries fields from the old mesh to the new one.
///
/// Vertices: around each old vertex a quadratic polynomial through its value, fitted to the ring;
/// over a face those of its corners, blended as the smooth surface is: third order on smooth
/// fields. Faces: linear about each old face, fitted to the three faces beside it, its mean over a
/// new face taken at four points: second order. Neither leaves the range of the values it is made
/// from, so that constants stay constant and nothing changes its sign; what has not moved keeps its
/// value.
///
/// Where a field is conserved, the values of a piece then change by one common fraction of their
/// size: v + c|v|. That keeps signs; a constant stays one, but follows the area of the mesh.
[[nodiscard]] SurfaceFields transferred(const SurfaceFields& fields, const SurfaceChange& change);

}  // namespace meniscus
