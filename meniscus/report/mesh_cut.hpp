#pragma once

#include <array>
#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus::report {

/// The section of one tetrahedron: a triangle or a quadrangle; of a curved one with more corners,
/// along its curved faces.
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
  std::vector<int> drops;               ///< ids by region, of region 1 first; −1 where not known
  std::array<double, 2> low{}, high{};  ///< the window of the plane that is shown
};

/// The cut normal to the y-axis (`normal` = 1) or the z-axis (2) through the middle of the drops.
/// Its window reaches three fifths of the drops' largest extent beyond them; polygons outside are
/// left out. A mesh without drops is cut through its middle, as a whole.
[[nodiscard]] MeshCut cut_through_drops(const io::VolumeFrame& mesh, int normal);

/// Fills an empty cut with the polygons of the tetrahedra that reach into its window, and their
/// values. It gets the ids of all drops of the mesh. Corners on the plane count as above it, so
/// that no cell is cut twice and none is missed. A curved tetrahedron may be cut in several
/// polygons.
void add_polygons(MeshCut& cut, const io::VolumeFrame& mesh);

}  // namespace meniscus::report
