#pragma once

#include <span>
#include <string>
#include <vector>

#include "meniscus/report/interface_picture.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/surface_frames.hpp"

namespace meniscus::report {

// Single pictures as the text of an .svg file; empty when the run has no data for them. Unreadable
// files are added to the run's faults.

/// The interface at the frames nearest to `times` [1/G], or at six between the first and the last
/// when none are given.
[[nodiscard]] std::string interface_svg(RunData& run, std::span<const double> times);
/// A picture with all plots of the history.
[[nodiscard]] std::string history_svg(const RunData& run);
/// A picture of D(t), with the reference where the run has one.
[[nodiscard]] std::string deformation_svg(const RunData& run);
/// The cut through the volume meshes nearest to `times`, or through the last one. Coloured by
/// liquid on the left, by quality on the right.
[[nodiscard]] std::string mesh_svg(RunData& run, std::span<const double> times);

/// One picture of a film: a frame with its time and key. Width and height are even, as video codecs
/// require.
struct MoviePicture {
  View view;
  ValueRange range;
  double width = 0.0, height = 0.0;  ///< [px]
};
[[nodiscard]] MoviePicture movie_picture(std::span<const SurfaceFrame> frames);
[[nodiscard]] std::string movie_svg(const SurfaceFrame& frame, const MoviePicture& picture);

}  // namespace meniscus::report
