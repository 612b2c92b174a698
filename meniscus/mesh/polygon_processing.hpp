#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/mesh/surface_repair.hpp"

namespace meniscus {

// CGAL's Polygon Mesh Processing, whose headers are heavy, behind plain types.

/// Cuts a polygon of four corners or more into triangles of its corners, turned as it is. It takes
/// a constrained Delaunay triangulation in its plane, or a fan where it has none.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> cut_polygon(std::span<const Vec3> corners);

/// Turns faces so that neighbours agree, in each piece as most of its faces are. False, and nothing
/// changed, where that is impossible without tearing the surface, or a face has a corner twice.
[[nodiscard]] bool make_consistent(SurfaceMesh& mesh);

/// Makes a closed surface of triangles as far as that can be done (`surface_of`); adds to `report`
/// what was done. Neighbours agree; pieces may be inside out.
[[nodiscard]] SurfaceMesh mended(const SurfaceMesh& mesh, RepairReport& report);

}  // namespace meniscus
