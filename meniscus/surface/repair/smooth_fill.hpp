#pragma once

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/surface/repair/face_patch.hpp"

namespace meniscus {

/// Closes every hole of a surface with boundaries by a patch as fine as the faces around it. They
/// join with a common tangent plane. The patch is the bi-Laplace surface (CGAL's hole filling). On
/// a tube of radius r it is a dome r/2 high. False when a hole cannot be filled; the mesh is then
/// as given.
[[nodiscard]] bool cap_holes(SurfaceMesh& mesh);

/// Gives a part of a closed surface triangles as fine as those around it. It moves their vertices,
/// and those of `rings` rings around, on the bi-Laplace surface that joins the rest with a common
/// tangent plane. False when that cannot be found; the mesh is then as given.
[[nodiscard]] bool smooth_part(SurfaceMesh& mesh, const FacePatch& part, int rings);

}  // namespace meniscus
