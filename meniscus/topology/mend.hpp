#pragma once

#include "meniscus/surface/remesh.hpp"

namespace meniscus {

/// Remeshes a surface; one that the remesher gives up on, because a flow has drawn a crease or
/// surgery left one that no smooth surface fits, is mended first: the faces beside sharp edges, and
/// rings of faces around them, are replaced by the bi-Laplace surface that joins the rest with a
/// common tangent plane, or cut out and closed as the ends of a neck are, and the volume is
/// restored. The mildest of several such mendings is taken that can be remeshed; triangles that
/// were evened out, which suffices where they were too few, may be rounded too; and a surface that
/// is crumpled all over is smoothed as a whole (`DiffusedSurface`) at last. On failure the mesh is
/// unchanged and the report is that of the first remeshing.
struct [[nodiscard]] MendReport {
  RemeshReport remesh;
  bool is_mended = false;      ///< the shape or its triangles were changed first
  int closed_holes = 0;        ///< holes through the drop that went with a crevice
  double smoothed_over = 0.0;  ///< [R0] length that the whole surface was smoothed over
};
MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& options);
/// The same, and fields follow: to a mended shape as to any that replaces another
/// (`replaced_fields`). On failure they are unchanged as well.
MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& options, SurfaceFields& fields);

}  // namespace meniscus
