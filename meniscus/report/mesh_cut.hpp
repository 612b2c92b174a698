#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/report/colormap.hpp"

namespace meniscus::report {

/// Where a plane meets one tetrahedron: a triangle or a quadrangle.
struct CutPolygon {
  std::size_t first_point = 0;
  int num_points = 0;
  int region = 0;                 ///< 0 the matrix, i + 1 what interface i encloses
  double min_dihedral_deg = 0.0;  ///< of the tetrahedron
};

/// Where the plane x[normal] = offset meets a mesh, in the coordinates along its two axes [R0].
struct MeshCut {
  int normal = 2;
  double offset = 0.0;
  std::string axes = "xy";  ///< names of the coordinates of `points`
  std::vector<std::array<double, 2>> points;
  std::vector<CutPolygon> polygons;
  std::array<double, 2> low{}, high{};  ///< the part of the plane to be looked at
};

/// The cut normal to the y-axis (`normal` = 1) or the z-axis (2) through the middle of what the
/// interfaces enclose, around it as far as three fifths of its largest extent; the polygons beyond
/// are left out. Of a mesh without interfaces: through the middle of all, as a whole.
[[nodiscard]] MeshCut cut_through_drops(const io::VolumeFrame& mesh, int normal);

/// Where the plane meets the tetrahedra that reach into the window given; corners on the plane
/// count as above it, so that no cell is cut twice and none is missed.
void add_polygons(MeshCut& cut, const io::VolumeFrame& mesh);

/// Smallest dihedral angles in degrees on the scale of colour.
[[nodiscard]] ValueRange quality_range();

enum class CutColors { liquid, quality };
/// The cut as the inside of an `svg` element, `width` px wide; its height is `cut_height`.
[[nodiscard]] std::string draw_cut(const MeshCut& cut, CutColors colors, double width);
[[nodiscard]] double cut_height(const MeshCut& cut, double width);
/// The key to the colours of the liquids, from (x, y) to the right.
[[nodiscard]] std::string draw_liquid_key(double x, double y);

}  // namespace meniscus::report
