#pragma once

#include "meniscus/surface/known_surfaces.hpp"

namespace meniscus {

/// Shifts every vertex by the same length along its area vector until the surface that the vertices
/// stand for encloses `volume`. Returns how far the surface moves on average [R0], signed outward.
///
/// Flat faces: by Newton's method, to round-off. Quadratic faces: shifts until they lack at most a
/// tenth of what they lacked, commonly a hundredth after one. A change of scale about the centroid
/// makes up for that exactly, to round-off. So it does for all where no shift brings the volume
/// nearer, as coarse surfaces' volumes jump while vertices shift. Where the quadratic faces' volume
/// is off by more than a factor of two, as on crumpled surfaces, it stays off.
double restore_volume(SurfaceMesh& mesh, double volume, SurfaceShape shape = SurfaceShape::faceted);
/// The same with surfaces that are known, and that will know the mesh's in the end.
double restore_volume(SurfaceMesh& mesh, double volume, SurfaceShape shape,
                      KnownSurfaces& surfaces);

/// Restores the flat faces' volume: vertices move by a length times their weights. Returns the
/// length.
double restore_volume(SurfaceMesh& mesh, double volume, const VertexField<double>& weights);

}  // namespace meniscus
