#pragma once

#include <map>
#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/report/mesh_cut.hpp"
#include "meniscus/report/surface_frames.hpp"
#include "meniscus/report/value_range.hpp"

namespace meniscus::report {

/// A frame or a cut packed for the page, with the facts needed before it is unpacked.
struct PackedFrame {
  double t = 0.0;
  std::string bytes;                             ///< a `Package`
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< the box around it [R0]
  int num_faces = 0,
      num_faces_of_run = 0;  ///< packed faces, and faces of the frame before coarsening
  bool is_curved = false;
  std::map<std::string, ValueRange> ranges = {};  ///< colour range of each field (`color_range`)
};

/// Packs a surface. Header: {t, vertices, faces, middles, wide, low, high, fields: [{name, low,
/// high}]}. Then come the corners a < b, c of all faces, in 16 or (wide) 32 bits. They are a minus
/// the previous face's a, b − a and c − a. Then come x, y, z of all vertices on a `Grid16`, as
/// differences. Of curved faces follow x, y, z of the `middles` of edges, in the order in which
/// faces name their edges 01, 12, 20. They are signed steps of that grid from the middle of the
/// edge's two vertices. Last come the values of each field on a `Grid16`, as differences. Vertices
/// are in Morton order, faces sorted by their corners.
[[nodiscard]] PackedFrame packed_surface(const SurfaceFrame& frame);

/// Packs the cuts of one time. Header: {t, cuts: [{axes, normal, offset, drops, window, polygons,
/// points, low, high, quality, fields: [{name, low, high}]}]}. Then come, for each cut, the number
/// of corners of every polygon, the regions and the qualities, each in 8 bits. Qualities are 0 to
/// 255 for 0 to `quality` degrees. The two coordinates of all points and the values of each field
/// on the polygons follow, both on a `Grid16`, as differences.
[[nodiscard]] PackedFrame packed_cuts(double t, const std::vector<MeshCut>& cuts);

}  // namespace meniscus::report
