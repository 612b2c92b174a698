#pragma once

#include <array>
#include <vector>

#include "meniscus/core/vec.hpp"

namespace meniscus::report {

/// The plane x[normal] = offset with its coordinates: x to the right, and z (normal to y) or y
/// (normal to z) upwards.
struct CutPlane {
  int normal = 2;
  double offset = 0.0;

  [[nodiscard]] double height(const Vec3& x) const { return x[normal] - offset; }
  [[nodiscard]] std::array<int, 2> axes() const {
    return normal == 2 ? std::array{0, 1} : std::array{0, 2};
  }
  [[nodiscard]] std::array<double, 2> in_plane(const Vec3& x) const {
    return {x[axes()[0]], x[axes()[1]]};
  }
};

/// A polygon in which a plane cuts a cell.
struct CellSection {
  std::vector<std::array<double, 2>> points;  ///< in coordinates of the plane
  /// The mean over the points of a function that is linear in the cell, as weights of its values at
  /// the cell's corners.
  std::array<double, 4> weights{};
};

/// The section of a tetrahedron with straight edges: a triangle, a quadrangle or none. Corners on
/// the plane count as above it.
[[nodiscard]] std::vector<CellSection> section_of(const std::array<Vec3, 4>& corners,
                                                  const CutPlane& plane);

/// The sections of a quadratic tetrahedron, one or several, by its corners and the middles of its
/// edges 01, 12, 20, 03, 13, 23. Its faces are taken as 16 flat pieces each, of which those of a
/// neighbour are the same.
[[nodiscard]] std::vector<CellSection> sections_of(const std::array<Vec3, 10>& nodes,
                                                   const CutPlane& plane);

}  // namespace meniscus::report
