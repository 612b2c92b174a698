#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/report/colormap.hpp"

namespace meniscus::report {

/// The section of one tetrahedron: a triangle or a quadrangle.
struct CutPolygon {
  std::size_t first_point = 0;
  int num_points = 0;
  int region = 0;                 ///< 0 the matrix, i + 1 what interface i encloses
  double min_dihedral_deg = 0.0;  ///< of the tetrahedron
};

/// The values of an array of a mesh on the polygons of a cut: the mean over the corners.
struct CutField {
  std::string name;
  std::vector<double> values;
};

/// The section of a mesh with the plane x[normal] = offset, in coordinates of the plane [R0].
struct MeshCut {
  int normal = 2;
  double offset = 0.0;
  std::string axes = "xy";  ///< names of the coordinates of `points`
  std::vector<std::array<double, 2>> points;
  std::vector<CutPolygon> polygons;
  std::vector<CutField> fields;         ///< all arrays of one value per point of the mesh
  std::array<double, 2> low{}, high{};  ///< the window of the plane that is shown
};

/// The cut normal to the y-axis (`normal` = 1) or the z-axis (2) through the middle of the drops.
/// Its window reaches three fifths of the drops' largest extent beyond them; polygons outside are
/// left out. A mesh without drops is cut through its middle, as a whole.
[[nodiscard]] MeshCut cut_through_drops(const io::VolumeFrame& mesh, int normal);

/// Fills an empty cut with the polygons of the tetrahedra that reach into its window, and with
/// their values. Corners on the plane count as above it, so that no cell is cut twice and none is
/// missed.
void add_polygons(MeshCut& cut, const io::VolumeFrame& mesh);

/// The colour range for smallest dihedral angles, in degrees.
[[nodiscard]] ValueRange quality_range();

enum class CutColors { liquid, quality };
/// The cut as the content of an `svg` element, `width` px wide and `cut_height` high.
[[nodiscard]] std::string draw_cut(const MeshCut& cut, CutColors colors, double width);
[[nodiscard]] double cut_height(const MeshCut& cut, double width);
/// The key to the colours of the liquids, starting at (x, y) and running to the right.
[[nodiscard]] std::string draw_liquid_key(double x, double y);

}  // namespace meniscus::report
