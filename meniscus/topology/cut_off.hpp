#pragma once

#include "meniscus/surface/repair/face_patch.hpp"
#include "meniscus/topology/section.hpp"

namespace meniscus {

/// What a section cuts off a closed surface on one side of its plane. Infinite where that comes
/// round to the other side, as an arm of a torus does and what is around its hole.
struct CutOff {
  double reach = 0.0;   ///< how far it goes from the plane [R0]
  double volume = 0.0;  ///< between it and the plane [R0³]
};

/// `side` is 1 for the side that the section's axis points to, −1 for the other. Follows the faces
/// there: linear in their number.
[[nodiscard]] CutOff cut_off(const SurfaceMesh& mesh, const FaceNeighbours& neighbours,
                             const Section& section, double side);

}  // namespace meniscus
