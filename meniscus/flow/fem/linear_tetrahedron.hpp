#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "meniscus/core/vec.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

/// What the closed-form P1 element matrices are made of.
struct LinearTetrahedron {
  double volume = 0.0;           ///< [R0³]
  std::array<Vec3, 4> gradient;  ///< of the shape functions [1/R0]
};

[[nodiscard]] inline LinearTetrahedron linear_tetrahedron(const TetMesh& mesh, CellId c) {
  const CellVertices& v = mesh.cells[c];
  const Vec3& o = mesh.x[v[0]];
  const Vec3 e1 = mesh.x[v[1]] - o, e2 = mesh.x[v[2]] - o, e3 = mesh.x[v[3]] - o;
  const Vec3 n1 = e2.cross(e3), n2 = e3.cross(e1), n3 = e1.cross(e2);
  const double determinant = e1.dot(n1);
  LinearTetrahedron tet;
  tet.volume = determinant / 6.0;
  const double scale = 1.0 / determinant;
  tet.gradient = {-scale * (n1 + n2 + n3), scale * n1, scale * n2, scale * n3};
  return tet;
}

/// Stabilisation parameter τ = 0.25 h²/μ, h half the edge of the regular tetrahedron of equal
/// volume, V = (2h)³/(6√2) (eq. 11 of hooper2001; the division by μ is not printed there).
[[nodiscard]] inline double pspg_parameter(double volume, double viscosity) {
  const double edge = std::cbrt(6.0 * std::numbers::sqrt2 * volume);
  return 0.25 * (0.25 * edge * edge) / viscosity;
}

}  // namespace meniscus::fem
