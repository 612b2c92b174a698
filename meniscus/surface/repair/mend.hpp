#pragma once

#include "meniscus/surface/repair/replacement.hpp"

namespace meniscus {

/// Remeshes a surface. One that the remesher gives up on is mended first. A flow may have drawn a
/// crease, or surgery left one, that no smooth surface fits. These remedies are tried, the mildest
/// first, until one leaves a surface that can be remeshed (`apply_first`):
///
/// 1. the faces beside sharp edges, and rings of faces around, give way to the bi-Laplace surface
///    that joins the rest with a common tangent plane;
/// 2. the flat faces are cut into even triangles, where they were too few;
/// 3. creases are cut out and the holes closed as the ends of a neck are;
/// 4. creases are rounded as in 1 after the faces were cut as in 2;
/// 5. the surface is smoothed as a whole (`DiffusedSurface`).
///
/// 2 leaves the shape as it was; the others restore the volume. Fields follow to a mended surface
/// as to any that replaces another (`replaced_fields`). On failure mesh and fields are unchanged,
/// and the report is that of the first remeshing.
MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& options, SurfaceFields& fields);
MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& options);

}  // namespace meniscus
