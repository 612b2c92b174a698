#pragma once

#include <cmath>

#include "meniscus/report/mesh_cut.hpp"

namespace meniscus::test {

/// The area of a polygon of a cut.
inline double area(const report::MeshCut& cut, const report::CutPolygon& polygon) {
  double sum = 0.0;
  const auto corner = [&](int k) {
    return cut.points[polygon.first_point + static_cast<std::size_t>(k % polygon.num_points)];
  };
  for (int k = 0; k < polygon.num_points; ++k) {
    const auto a = corner(k), b = corner(k + 1);
    sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return std::abs(sum);
}

}  // namespace meniscus::test
