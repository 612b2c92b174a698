#pragma once

#include <Eigen/SparseCore>

#include "meniscus/transport/carrier_surface.hpp"

namespace meniscus {

/// What the functions φ_v of the vertices hold of a concentration Γ = Σ_w φ_w Γ_w on a closed
/// surface:
///
///   m_v = ∫φ_v Γ dS = Σ_w M_vw Γ_w [R0²],   M_vw = ∫φ_v φ_w dS,   S_v = ∫φ_v dS.
///
/// φ_v is quadratic on every face, and what `CarrierSurface` makes of the value 1 at v and 0 at the
/// other vertices. The φ_v add up to 1, the amounts to Σ_v S_v Γ_v.
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
