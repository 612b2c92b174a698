#pragma once

#include "meniscus/report/surface_frames.hpp"
#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// The section of each drop of a frame with the plane through its centroid normal to the y-axis
/// (`normal` = 1) or the z-axis (2). Closed curves in x and z, or in x and y [R0], with a gap after
/// each.
[[nodiscard]] Curve section_through_centroids(const SurfaceFrame& frame, int normal);

}  // namespace meniscus::report
