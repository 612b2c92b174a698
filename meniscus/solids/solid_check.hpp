#pragma once

#include <optional>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// What makes a surface unfit as the boundary of solid bodies, with the place. There is none when
/// it is finite, closed, manifold and oriented, without degenerate faces or self-intersections. As
/// `find_defect`, but of any number of pieces: one may lie inside another, and one that is inside
/// out must (a cavity).
[[nodiscard]] std::optional<Fault> find_solid_defect(const SurfaceMesh& mesh);

}  // namespace meniscus
