#pragma once

#include <Eigen/SparseCore>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The amounts m_v = ∫φ_v Γ dS = Σ_w M_vw Γ_w of a concentration that is linear on the flat faces
/// of a closed surface, and back; M_vw = ∫φ_v φ_w dS [R0²]. The amounts add up to Σ_v Γ_v S_v, S_v
/// a third of the area of the faces at v. m_v/S_v, which a lumped M would take for Γ_v, is a mean
/// over the faces around: at 400 vertices it makes a mode l = 2 one percent too low.
[[nodiscard]] VertexField<double> vertex_amounts(const SurfaceMesh& mesh,
                                                 const VertexField<double>& concentration);
[[nodiscard]] VertexField<double> concentration_of(const SurfaceMesh& mesh,
                                                   const VertexField<double>& amounts);

/// Convection and diffusion of a concentration Γ on a closed surface whose vertices move, by linear
/// finite elements on its flat faces (dziuk2007): for every vertex v
///
///   dm_v/dt = −Σ_w L_vw Γ_w,   L = D K (I + S⁻¹M)/2 − C,
///   K_vw = ∫∇φ_v·∇φ_w dS,   C_vw = ∫φ_w s·∇φ_v dS,
///
/// m_v being its amount, s the velocity of the liquid along the surface relative to the vertices
/// [G R0], D the diffusivity [G R0²], S the diagonal matrix of the S_v. The columns of L add up to
/// zero: the total amount is constant to round-off. On equilateral triangles of edge h a wave of
/// number q has the symbols 1 − h²q²/8 of S⁻¹M and of S⁻¹C beside iq·s, and q²(1 − h²q²/16) of
/// S⁻¹K: with the mean of Γ and S⁻¹MΓ diffusion is of fourth order there, as convection is. How
/// surface is stretched and compressed is in M. Of second order in the length of edges; nothing
/// keeps Γ within its range where it varies by much from one vertex to the next.
class SurfaceTransport {
 public:
  /// `slip` is v − ẋ at the vertices, of which the part along the area vector is left out.
  SurfaceTransport(const SurfaceMesh& mesh, const VertexField<Vec3>& slip, double diffusivity);

  /// −L Γ [G R0²].
  [[nodiscard]] VertexField<double> rates(const VertexField<double>& concentration) const;

  /// A step of length dt takes the surface from `start` with velocities `motion` of its vertices.
  struct Path {
    const SurfaceMesh& start;
    const VertexField<Vec3>& motion;
    double dt = 0.0;
  };
  /// The constant rates that take the amounts of a concentration through a step with this L: the
  /// implicit Runge–Kutta scheme of second order and two stages that is stable and damps without
  /// limit (SDIRK2, alexander1977). With the L of the middle of the step it remains of second
  /// order.
  [[nodiscard]] VertexField<double> mean_rates(const VertexField<double>& concentration,
                                               const Path& path) const;

 private:
  Eigen::SparseMatrix<double> L_;
};

}  // namespace meniscus
