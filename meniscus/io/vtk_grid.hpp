#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "meniscus/io/vtk_file.hpp"

namespace meniscus::io {

/// VTK's names of triangles (3 corners) and tetrahedra (4), and the edges over whose middles the
/// further nodes of a quadratic one lie.
template <std::size_t Corners>
struct VtkCell;
template <>
struct VtkCell<3> {
  static constexpr VTKCellType flat = VTK_TRIANGLE, quadratic = VTK_QUADRATIC_TRIANGLE;
  static constexpr std::array<std::array<std::size_t, 2>, 3> edges = {{{0, 1}, {1, 2}, {2, 0}}};
};
template <>
struct VtkCell<4> {
  static constexpr VTKCellType flat = VTK_TETRA, quadratic = VTK_QUADRATIC_TETRA;
  static constexpr std::array<std::array<std::size_t, 2>, 6> edges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
};

/// Makes an unstructured grid of triangles or tetrahedra, some of them with curved edges. Points
/// are those of the corners, as added, then the middles of quadratic cells' edges.
class GridBuilder {
 public:
  /// `num_corner_points`: how many points will be added.
  GridBuilder(const CurvedEdges& curved, std::size_t num_corner_points);

  void add_point(const Vec3& x) { points_.push_back(x); }
  /// A cell by its vertices, which `curved` names, and by the points of its corners.
  template <std::size_t Corners>
  void add_cell(const std::array<std::int32_t, Corners>& vertices,
                const std::array<vtkIdType, Corners>& corners);

  /// The grid without arrays, once all is added.
  [[nodiscard]] vtkNew<vtkUnstructuredGrid> grid() const;
  /// An array of the corners' points with its values at the middles.
  [[nodiscard]] NamedArray at_all_points(NamedArray array) const;

 private:
  struct Middle {
    vtkIdType a, b;                   ///< the points at the edge's ends
    std::optional<std::size_t> edge;  ///< of `curved_`; none where straight
  };
  [[nodiscard]] std::optional<std::size_t> curved_edge(std::int32_t a, std::int32_t b) const;
  vtkIdType middle(vtkIdType a, vtkIdType b, std::optional<std::size_t> edge);

  const CurvedEdges& curved_;
  std::size_t num_corner_points_;
  std::unordered_map<std::uint64_t, std::size_t> edges_;  // by vertices
  std::vector<Vec3> points_;                              // of corners
  std::vector<Middle> middles_;
  std::unordered_map<std::uint64_t, vtkIdType> middle_points_;  // by the points at the ends
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkUnsignedCharArray> types_;
};

}  // namespace meniscus::io
