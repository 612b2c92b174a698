#pragma once

#include "meniscus/report/surface_frames.hpp"
#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// Where each drop of a frame meets the plane through its centroid normal to the y-axis (`normal`
/// = 1) or the z-axis (2): closed curves in x and z, or in x and y [R0], a gap after each.
[[nodiscard]] Curve section_through_centroids(const SurfaceFrame& frame, int normal);

}  // namespace meniscus::report
