#pragma once

#include "meniscus/report/surface_frames.hpp"
#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// Where each drop of a frame meets the plane z = z_c through its centroid: closed curves in x and
/// y [R0], a gap after each.
[[nodiscard]] Curve section_through_centroids(const SurfaceFrame& frame);

}  // namespace meniscus::report
