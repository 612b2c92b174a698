#pragma once

#include "meniscus/transport/surface_mass.hpp"

namespace meniscus {

/// Convection and diffusion of a concentration Γ on a closed surface whose vertices move. By finite
/// elements that are quadratic on its faces (dziuk2007, demlow2009), for every vertex v
///
///   dm_v/dt = −Σ_w L_vw Γ_w,   L = D K − C,   K_vw = ∫∇φ_v·∇φ_w dS,   C_vw = ∫φ_w s·∇φ_v dS,
///
/// m_v and φ_v being those of `SurfaceMass`. D is the diffusivity [G R0²], s the velocity of the
/// liquid along the surface relative to the vertices [G R0]. The columns of L add up to zero: the
/// total amount is constant to round-off. How surface is stretched and compressed is in the mass.
/// Nothing keeps Γ within its range where it varies by much from one vertex to the next.
class SurfaceTransport {
 public:
  /// `slip` is v − ẋ at the vertices, of which the part along the area vector is left out.
  SurfaceTransport(const CarrierSurface& surface, const VertexField<Vec3>& slip,
                   double diffusivity);

  /// Of L = a L_1 + b L_2, both of the same vertices.
  SurfaceTransport(double a, const SurfaceTransport& first, double b,
                   const SurfaceTransport& second);

  /// −L Γ [G R0²].
  [[nodiscard]] VertexField<double> rates(const VertexField<double>& concentration) const;

  /// A step of length dt and the surface at both of its ends.
  struct Path {
    const SurfaceMass& start;
    const SurfaceMass& end;
    double dt = 0.0;
  };
  /// The constant rates that take the amounts of a concentration through a step (with this L). They
  /// are of the implicit Runge–Kutta scheme of second order and two stages that is stable and damps
  /// without limit (SDIRK2, alexander1977). With the L of the middle of the step it remains of
  /// second order.
  [[nodiscard]] VertexField<double> mean_rates(const VertexField<double>& concentration,
                                               const Path& path) const;
  /// What constant sources of amounts add to these rates: themselves, and how they are carried
  /// [G R0²]. The sum of both is that of the sources.
  [[nodiscard]] VertexField<double> rates_of_sources(const VertexField<double>& sources,
                                                     const Path& path) const;

  /// The concentration c that amounts m stand for, less what a step of length dt would even out. It
  /// has (M + γdt L) c' = m, (M + γdt L) c = Mc', γ being that of the stages. Smooth amounts keep
  /// theirs.
  [[nodiscard]] VertexField<double> settled(const VertexField<double>& amounts,
                                            const SurfaceMass& mass, double dt) const;

 private:
  [[nodiscard]] Eigen::VectorXd mean_rates(const Eigen::VectorXd& amounts,
                                           const Eigen::VectorXd& sources, const Path& path) const;

  Eigen::SparseMatrix<double> L_;
};

}  // namespace meniscus
