#pragma once

#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/surface/curvature.hpp"

namespace meniscus {

/// The closed curves in which the plane through `origin` normal to `axis` cuts a surface. The
/// surface's edges are taken as the cubics that leave each end at right angles to its fitted
/// normal. So the points lie on the smooth interface to third order, not on its chords.
[[nodiscard]] std::vector<std::vector<Vec3>> plane_section(const SurfaceMesh& mesh,
                                                           const SurfaceTopology& topology,
                                                           const VertexField<VertexCurvature>& fit,
                                                           const Vec3& origin, const Vec3& axis);

/// Largest or smallest distance from `origin` to a set of closed curves, with the point where it is
/// reached. It is the extremum of the parabola through the extreme point and its two neighbours.
struct ExtremeDistance {
  double distance = 0.0;
  Vec3 point = Vec3::Zero();
};
[[nodiscard]] ExtremeDistance largest_distance(const std::vector<std::vector<Vec3>>& curves,
                                               const Vec3& origin);
[[nodiscard]] ExtremeDistance smallest_distance(const std::vector<std::vector<Vec3>>& curves,
                                                const Vec3& origin);

}  // namespace meniscus
