#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Whether a closed surface is too rough for a smooth surface to be fitted to: normals turned by
/// more than 50° along an edge, or a twentieth of the angles below 15°.
[[nodiscard]] bool is_rough(const SurfaceMesh& mesh, const SurfaceTopology& topology);

/// The same polyhedron with triangles of edges about `edge`: CGAL's isotropic remeshing, new
/// vertices on the given faces, creases (above 50°) kept as lines of edges.
[[nodiscard]] SurfaceMesh evened_out(const SurfaceMesh& mesh, double edge);

}  // namespace meniscus
