#pragma once

#include <span>
#include <string>

#include "meniscus/core/vec.hpp"
#include "meniscus/report/colormap.hpp"
#include "meniscus/report/surface_frames.hpp"

namespace meniscus::report {

/// How space is put on a picture: parallel rays along `toward` (at the eye), lengths kept.
struct View {
  Vec3 right, up, toward;            ///< orthonormal
  double scale = 100.0;              ///< [px/R0]
  double width = 0.0, height = 0.0;  ///< of the picture [px]
};

/// The one view in which all frames, each in the middle of its picture, fit a given width: upon the
/// flow plane (x to the right, y up), from a little above and beside.
[[nodiscard]] View common_view(std::span<const SurfaceFrame> frames, double width);

/// Curvatures of all frames on one scale of colour.
[[nodiscard]] ValueRange curvature_range(std::span<const SurfaceFrame> frames);

/// Whether all frames have curvatures to be coloured by.
[[nodiscard]] bool have_curvature(std::span<const SurfaceFrame> frames);

/// One frame as the inside of an `svg` element of the view's size: its faces as triangles, the far
/// ones first, coloured by curvature and lit from above the viewer's left shoulder.
[[nodiscard]] std::string draw_surface(const SurfaceFrame& frame, const View& view,
                                       const ValueRange& range);

/// The key to such pictures: colours with their values, the length R0 and the axes of the view.
struct PictureKey {
  static constexpr double width = 560.0, height = 62.0;  ///< [px]
};
[[nodiscard]] std::string draw_key(const View& view, const ValueRange& range, bool has_colors);

/// A scale of colour with marks and a label, `width` px long, its upper left corner at (x, y).
[[nodiscard]] std::string draw_color_bar(const ValueRange& range, std::string_view label, double x,
                                         double y, double width);

}  // namespace meniscus::report
