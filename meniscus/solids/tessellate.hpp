#pragma once

#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// Flat faces that lie within about `chordal_error` [R0] of the smooth surface of `mesh`. Each of
/// its faces is cut into n² on the surface, n ≤ 8 by the error max|k| l²/6n² of the pieces (see
/// `remesh_to`). For measuring distances: faces do not share their vertices.
[[nodiscard]] SurfaceMesh tessellation(const SurfaceMesh& mesh, const SmoothSurface& surface,
                                       double chordal_error);

}  // namespace meniscus
