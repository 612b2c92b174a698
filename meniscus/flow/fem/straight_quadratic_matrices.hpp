#pragma once

#include "meniscus/flow/fem/cell_matrices.hpp"

namespace meniscus::fem {

/// The matrices of a straight quadratic cell in closed form, with ∫b_k b_l = V (1 + δ_kl)/20 of
/// barycentric coordinates. With G_kl = μV g_k g_lᵀ, g_k = ∇b_k, and γ_kl = 3/5 where k = l, −1/5
/// elsewhere,
///   ∫μ∇φ∇φᵀ = γ_kl G_kl                       of corners k, l,
///           = γ_kp G_kq + γ_kq G_kp           of a corner k and the edge (p, q),
///           = 4/5 Σ (1 + δ) G                 of two edges (p, q), (r, s): (1 + δ_pr) G_qs and the
///                                             three others in which p, q and r, s change places.
class StraightQuadraticMatrices : public CellMatrices<QuadraticElement> {
 public:
  StraightQuadraticMatrices(const LinearTetrahedron& tet, double viscosity);
};

}  // namespace meniscus::fem
