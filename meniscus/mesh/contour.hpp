#pragma once

#include <array>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Values at the points of a cubic lattice, x fastest.
struct Lattice {
  Vec3 low = Vec3::Zero();  ///< position of the first point [R0]
  double spacing = 0.0;     ///< [R0]
  std::array<int, 3> size{};
  std::vector<double> values;

  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  [[nodiscard]] Vec3 position(int i, int j, int k) const { return low + spacing * Vec3(i, j, k); }
};

/// The surface around the points whose values are below `level`, by linear interpolation in the six
/// tetrahedra of each cube. It is closed, manifold, outward and without self-intersection, where no
/// point on the faces of the lattice is below it. Its triangles are of any shape; none is shorter
/// than a twentieth of the spacing, for which vertices move by as much.
[[nodiscard]] SurfaceMesh contour(const Lattice& lattice, double level);

}  // namespace meniscus
