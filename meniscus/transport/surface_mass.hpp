#pragma once

#include <Eigen/SparseCore>

#include "meniscus/transport/carrier_surface.hpp"

namespace meniscus {

/// What the linear functions φ_v of the vertices hold of a concentration Γ on a closed surface:
///
///   m_v = ∫φ_v Γ dS ≈ Σ_w M_vw Γ_w [R0²],   M = (S + N)/2,   N_vw = ∫φ_v φ_w dS,   S_v = ∫φ_v dS.
///
/// On equilateral triangles of edge h a smooth wave of number q has ∫φ_v Γ dS = S_v(1 − h²q²/16)Γ_v
/// to fourth order. Lumped masses S, and consistent ones N of symbol 1 − h²q²/8, miss that by as
/// much on either side. The amounts add up to Σ_v S_v Γ_v.
class SurfaceMass {
 public:
  explicit SurfaceMass(const CarrierSurface& surface);

  [[nodiscard]] VertexField<double> amounts(const VertexField<double>& concentration) const;
  [[nodiscard]] VertexField<double> concentration(const VertexField<double>& amounts) const;
  /// Σ_v S_v Γ_v.
  [[nodiscard]] double total(const VertexField<double>& concentration) const;
  /// S_v.
  [[nodiscard]] VertexField<double> areas() const;

  /// M.
  [[nodiscard]] const Eigen::SparseMatrix<double>& matrix() const { return M_; }

 private:
  Eigen::SparseMatrix<double> M_;
};

}  // namespace meniscus
