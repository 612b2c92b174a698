#pragma once

#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/surface/smooth_surface.hpp"
#include "meniscus/surface/surface_walk.hpp"

namespace meniscus {

/// The surface that fields come from, and where on it the vertices of the new mesh lie.
struct SurfaceChange {
  const SurfaceMesh& before;
  const SurfaceTopology& topology;  ///< of `before`
  const SmoothSurface& surface;     ///< of `before`
  const SurfaceWalk& walk;          ///< on `before`
  const SurfaceMesh& after;
  const VertexField<SurfacePoint>& points;  ///< on `before`, of the vertices of `after`
};

/// Carries fields from the old mesh to the new one.
///
/// Vertices: around each old vertex a quadratic polynomial through its value, fitted to the ring.
/// Over a face those of its corners, blended as the smooth surface is: third order on smooth
/// fields. Faces: linear about each old face, fitted to the three faces beside it, its mean over a
/// new face taken at four points: second order. Neither leaves the range of the values it is made
/// from, so that constants stay constant and nothing changes its sign. What has not moved keeps its
/// value.
///
/// Where a field is conserved, parts of the old faces give what they held beyond the new values to
/// the nearest new elements (`keep_amounts`). Second order. What the area of the mesh gained or
/// lost is shared by the piece within the old range, beyond it in equal parts. A constant stays
/// one, but follows the area.
ReplacedFields transferred_fields(const SurfaceFields& fields, const SurfaceChange& change);

}  // namespace meniscus
