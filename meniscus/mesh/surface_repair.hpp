#pragma once

#include <optional>
#include <string>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/polygon_soup.hpp"
#include "meniscus/mesh/shapes.hpp"

namespace meniscus {

/// What was done to faces to make a surface of them.
struct RepairReport {
  int polygons = 0;  ///< faces of more than three corners, cut into triangles
  int turned = 0;    ///< faces turned over
  // By mending.
  int merged_points = 0;      ///< points dropped for others at the same place
  int removed_faces = 0;      ///< doubled or without area
  int stitched_edges = 0;     ///< pairs of edges of borders that lay on each other
  int filled_holes = 0;       ///< holes closed by new faces
  double largest_hole = 0.0;  ///< diagonal of the box of the largest of them
  int crossing_faces = 0;     ///< faces that crossed others and were replaced
  std::optional<Fault> left;  ///< a hole that is too large to fill, the largest

  [[nodiscard]] bool is_changed() const;
};

/// What was done, in words: "6 faces of more than three corners cut into triangles; 2 faces
/// turned over"; empty if nothing was.
[[nodiscard]] std::string text_of(const RepairReport& report);
/// The fault of a surface after repair, with the hole that was left if there is one.
[[nodiscard]] std::string text_of(const Fault& fault, const RepairReport& report);

struct RepairedSurface : TaggedSurface {
  RepairReport report;
};

/// Holes with a box of a larger diagonal than this fraction of the surface's are not filled.
inline constexpr double kLargestHole = 0.1;

/// A surface of polygons whose corners name points that are there, and whose coordinates are
/// finite. Faces of more than three corners are cut into triangles. Where the faces form a closed
/// manifold they are turned so that neighbours agree. No piece is inside out then but those that
/// lie in another, as cavities. Points that no face uses are left out. Faces that need none of this
/// stay as they are, in their order.
///
/// With `mends`, what is no sound surface then (`find_solid_defect`) is mended by CGAL's Polygon
/// Mesh Processing. Points at one place are merged, doubled faces and faces without area removed,
/// borders stitched, small holes filled, and faces that cross replaced. Tags of new faces are those
/// of the nearest given ones. What cannot be mended stays: the result is to be checked.
[[nodiscard]] RepairedSurface surface_of(const PolygonSoup& soup, bool mends);

}  // namespace meniscus
