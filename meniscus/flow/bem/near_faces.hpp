#pragma once

#include <vector>

#include "meniscus/flow/bem/boundary_geometry.hpp"

namespace meniscus::bem {

/// Replaces `faces` by those of surface m that are near point i, in rising order: their centre is
/// closer than two of their longest edges. Beyond, the nodes of a face with their areas take over.
void find_near_faces(const BoundaryGeometry& geometry, std::size_t m, std::int32_t i,
                     std::vector<FaceId>& faces);

/// Which corner of a face of surface m a point is; 3 for none.
[[nodiscard]] std::size_t corner_at(const BoundaryGeometry& geometry, std::size_t m, FaceId f,
                                    std::int32_t i);

}  // namespace meniscus::bem
