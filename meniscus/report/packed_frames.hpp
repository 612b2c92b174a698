#pragma once

#include <map>
#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/report/colormap.hpp"
#include "meniscus/report/mesh_cut.hpp"
#include "meniscus/report/surface_frames.hpp"

namespace meniscus::report {

/// A frame or a cut as the page takes it, with what must be known before it is unpacked.
struct PackedFrame {
  double t = 0.0;
  std::string bytes;                              ///< a `Package`
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();   ///< the box around it [R0]
  int num_faces = 0, num_faces_of_run = 0;        ///< packed, and before any were left out
  std::map<std::string, ValueRange> ranges = {};  ///< of each field, without the wildest values
};

/// A surface: header {t, vertices, faces, wide, low, high, fields: [{name, low, high}]}; then of
/// every face its corners a < b, c as a less the a of the face before, b − a and c − a, in 16 or
/// (wide) 32 bits; then x, y, z of all vertices and the values of each field on a `Grid16`, as
/// differences. The vertices are put in an order in which neighbours follow each other, the faces
/// in that of their corners.
[[nodiscard]] PackedFrame packed(const SurfaceFrame& frame);

/// Cuts of one moment: header {t, cuts: [{axes, normal, offset, window, polygons, points, low,
/// high, quality}]}; then for each cut the number of corners of every polygon (8 bits), its region
/// (8 bits), its quality (8 bits, 0 to 255 for 0 to `quality` degrees) and all points, two numbers
/// each on a `Grid16`, as differences.
[[nodiscard]] PackedFrame packed(double t, const std::vector<MeshCut>& cuts);

}  // namespace meniscus::report
