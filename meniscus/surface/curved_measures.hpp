#pragma once

#include "meniscus/core/vec.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Measures of the closed surface of parabolic triangles through the vertices and the
/// `edge_middles`: what a triangulation stands for, to O(h⁴), where its flat faces enclose too
/// little by O(h²).
struct CurvedMeasures {
  double volume = 0.0;                 ///< [R0³]
  double area = 0.0;                   ///< [R0²]
  Mat3 second_moments = Mat3::Zero();  ///< ∫ (x − c)(x − c)ᵀ dV about the centroid c [R0⁵]
};
[[nodiscard]] CurvedMeasures curved_measures(const SurfaceMesh& mesh);

/// The integrals over that surface of which a drop's stress is made.
struct SurfaceMoments {
  double volume = 0.0;           ///< [R0³]
  Mat3 normals = Mat3::Zero();   ///< ∫ nn dS [R0²]
  Mat3 velocity = Mat3::Zero();  ///< ∫ un dS [G R0³], u quadratic on the faces
};
/// The middles of edges get `u` from the quadratics that fit it around both ends: O(h³).
[[nodiscard]] SurfaceMoments curved_moments(const SurfaceMesh& mesh, const VertexField<Vec3>& u);

/// Unit normals of the smooth surface at the vertices, O(h³).
[[nodiscard]] VertexField<Vec3> smooth_normals(const SurfaceMesh& mesh);

/// Shifts every vertex by the same multiple of its unit area vector so that the parabolic triangles
/// enclose `volume` to 1e-12 relative; returns the size of the shift [R0], signed outward. Where no
/// such shift is found, as coarse surfaces' volumes jump while vertices shift, what is left is made
/// up for by a change of scale about the centroid; not where the curved volume is off by more than
/// a factor of two, as on crumpled surfaces: it then stays off.
double restore_curved_volume(SurfaceMesh& mesh, double volume);

}  // namespace meniscus
