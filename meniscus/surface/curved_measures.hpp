#pragma once

#include "meniscus/surface/edge_middles.hpp"

namespace meniscus {

/// Measures of the closed surface of parabolic triangles through the vertices and the
/// `edge_middles`: what a triangulation stands for, to O(h⁴), where its flat faces enclose too
/// little by O(h²).
struct CurvedMeasures {
  double volume = 0.0;                 ///< [R0³]
  double area = 0.0;                   ///< [R0²]
  Mat3 second_moments = Mat3::Zero();  ///< ∫ (x − c)(x − c)ᵀ dV about the centroid c [R0⁵]
};
[[nodiscard]] CurvedMeasures curved_measures(const SurfaceMesh& mesh, SurfaceShape shape);

/// The integrals over that surface of which a drop's stress is made.
struct SurfaceMoments {
  double volume = 0.0;           ///< [R0³]
  Mat3 normals = Mat3::Zero();   ///< ∫ nn dS [R0²]
  Mat3 velocity = Mat3::Zero();  ///< ∫ un dS [G R0³], u quadratic on the faces
};
/// The middles of edges get `u` from the quadratics that fit it around both ends: O(h³).
[[nodiscard]] SurfaceMoments curved_moments(const SurfaceMesh& mesh, const VertexField<Vec3>& u,
                                            SurfaceShape shape);

/// Unit normals of the smooth surface at the vertices, O(h³).
[[nodiscard]] VertexField<Vec3> smooth_normals(const SurfaceMesh& mesh);

/// Shifts every vertex by the same multiple of its unit area vector until the parabolic triangles
/// lack at most a tenth of what they lacked of `volume`, commonly a hundredth after one shift; a
/// change of scale about the centroid makes up for that exactly, to round-off. So it does for all
/// where no shift brings the volume nearer, as coarse surfaces' volumes jump while vertices shift;
/// not where the curved volume is off by more than a factor of two, as on crumpled surfaces: it
/// then stays off. Returns how far the surface moves on average [R0], signed outward.
double restore_curved_volume(SurfaceMesh& mesh, double volume, SurfaceShape shape);

}  // namespace meniscus
