#pragma once

#include <vector>

#include "meniscus/flow/bem/boundary_geometry.hpp"

namespace meniscus::bem {

/// Replaces `faces` by those of surface m that are near point i, in rising order. On the point's
/// own sheet their centre is closer than two of their longest edges. On another sheet, of another
/// surface or across a film or a neck, it is closer than four.
///
/// Beyond, the weights of a face's vertices take over. Around the point on its own sheet errors of
/// neighbours nearly cancel. On another sheet they do not. At 2, 3, 4 edges from the unit sphere of
/// 1000 vertices the double layer is wrong by 2e-3, 8e-4, 4e-4 of its size. Where no constant is
/// subtracted under the integral (`NearReach::whole`), neighbours do not cancel either, and four
/// edges count everywhere.
enum class NearReach { subtracted, whole };
void find_near_faces(const BoundaryGeometry& geometry, std::size_t m, std::int32_t i,
                     std::vector<FaceId>& faces, NearReach reach = NearReach::subtracted);

/// Which corner of a face of surface m a point is; 3 for none.
[[nodiscard]] std::size_t corner_at(const BoundaryGeometry& geometry, std::size_t m, FaceId f,
                                    std::int32_t i);

}  // namespace meniscus::bem
