#pragma once

#include <span>
#include <string>

#include "meniscus/core/vec.hpp"
#include "meniscus/report/colormap.hpp"
#include "meniscus/report/surface_frames.hpp"

namespace meniscus::report {

/// A parallel projection onto a picture, along `toward` (which points to the viewer).
struct View {
  Vec3 right, up, toward;            ///< orthonormal
  double scale = 100.0;              ///< [px/R0]
  double width = 0.0, height = 0.0;  ///< of the picture [px]
};

/// A common view for all frames, in which each frame fits a given width. It looks at the flow plane
/// (x to the right, y up) slightly from above and from the side.
[[nodiscard]] View common_view(std::span<const SurfaceFrame> frames, double width);

/// The colour range for the curvatures of all frames.
[[nodiscard]] ValueRange curvature_range(std::span<const SurfaceFrame> frames);

/// Whether every frame has curvatures.
[[nodiscard]] bool have_curvature(std::span<const SurfaceFrame> frames);

/// One frame as the content of an `svg` element of the view's size. Faces are drawn as triangles,
/// the farthest first, coloured by curvature and lit from the upper left.
[[nodiscard]] std::string draw_surface(const SurfaceFrame& frame, const View& view,
                                       const ValueRange& range);

/// The key of a surface picture: colour scale, the length R0 and the axes of the view.
struct PictureKey {
  static constexpr double width = 560.0, height = 62.0;  ///< [px]
};
[[nodiscard]] std::string draw_key(const View& view, const ValueRange& range, bool has_colors);

/// A colour scale with marks and a label, `width` px long, with its upper left corner at (x, y).
[[nodiscard]] std::string draw_color_bar(const ValueRange& range, std::string_view label, double x,
                                         double y, double width);

}  // namespace meniscus::report
