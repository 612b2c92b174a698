#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace meniscus::linear {

/// A sparse matrix in compressed rows; on one rank columns rise in each row. The arrays are the
/// caller's and must outlive every solver that was given the view.
///
/// A matrix distributed over ranks has `num_rows` rows on each. Vectors that it is applied to have
/// `num_columns` entries there. Both are numbered rank by rank. `columns` holds global numbers, in
/// each row the owned ones first, then the ghosts. Arrays may go on beyond the last row.
struct CsrView {
  std::int32_t num_rows = 0, num_columns = 0;
  std::span<const std::int32_t> row_start;  ///< num_rows + 1
  std::span<const std::int32_t> columns;
  std::span<const double> values;
};

/// A matrix given by its action: writes A x to `result`.
using LinearOperator = std::function<void(std::span<const double> x, std::span<double> result)>;

/// The products with a saddle system (below) whose blocks are not given as matrices. Collective.
struct SaddleProducts {
  LinearOperator whole;     ///< [A Bᵀ; B −C]
  LinearOperator gradient;  ///< Bᵀ, or what is near it, for preconditioners
  /// ∫μ∇φ·∇φ of each component, three side by side, or what it was with the preconditioner kept.
  LinearOperator laplacians;
};

/// The system of a mixed velocity-pressure problem with n nodes and m pressures,
///   [A  Bᵀ] [v]   [f]
///   [B  −C] [p] = [g],
/// symmetric unless `lower_left` replaces the lower left B. The velocity's three components stand
/// side by side at each node, all velocities before all pressures.
/// Constrained unknowns have been eliminated: their rows and columns hold the diagonal alone.
/// On several ranks n and m count the owned nodes and pressures, and each rank has its velocities,
/// then its pressures.
struct SaddleSystem {
  CsrView A;  ///< 3n × 3n, positive definite
  CsrView B;  ///< m × 3n
  CsrView C;  ///< m × m, positive semi-definite
  /// Scalar n × n Laplacians ∫μ∇φ·∇φ that stand for A's diagonal blocks. `laplacian_of` says which
  /// belongs to each component; they differ only in the nodes eliminated. Where there are products,
  /// the Laplacians of linear functions, to which `interpolations` lead.
  std::vector<CsrView> laplacians;
  std::array<int, 3> laplacian_of = {0, 0, 0};
  std::span<const double> pressure_mass;  ///< m, lumped ∫ψψ/μ: stands for the Schur complement
  /// The constant pressure is a null vector (no open boundary). The right-hand side must then sum
  /// to zero over the pressures, and the solution's pressures do.
  bool constant_pressure_is_null = false;
  /// For quadratic velocities, per Laplacian, the interpolation from the linear functions of the
  /// same mesh: one level of multigrid by degree above the algebraic ones. Else empty.
  std::vector<CsrView> interpolations = {};
  /// Values of the lower left block where it is not B, on B's pattern: a stabilisation by a
  /// viscosity that depends on the velocity. Empty: B. MINRES, which needs symmetry, takes B, and
  /// so does every preconditioner.
  std::span<const double> lower_left = {};
  /// The pressure mass matrix ∫ψψ/μ before lumping, which stands for the Schur complement better
  /// where nothing stabilises. Empty: the lumped one does.
  CsrView consistent_mass = {};
  /// Groups of pressures: χ w_r χᵀ is added to the inverse of the mass matrix, where χ is 1 in
  /// group r and 0 elsewhere. Empty: no groups.
  std::span<const std::int32_t> group_of_pressure = {};
  std::span<const double> group_weights = {};  ///< w_r ≥ 0
  /// Functions, as rows with this rank's 3n or m entries, on which the matrices above do not stand
  /// for A and for the Schur complement. The block solver and MINRES make these two on their span.
  /// With no rows: there are none.
  CsrView slow_velocities = {}, slow_pressures = {};
  /// Where given, A, B and C have no entries. For the block solver and MINRES.
  SaddleProducts products = {};
  std::span<const double> laplacian_diagonals = {};  ///< 3n, of `products.laplacians`

  /// Where velocities have masses M that outweigh the Laplacians: B, and a diagonal for M, 3n. To
  /// the inverse of the Schur complement that of B diag(M)⁻¹ Bᵀ + C is added. Empty: they do not.
  CsrView divergence = {};
  std::span<const double> mass_diagonal = {};

  /// What the entries of a residual count, size(): the block solver with products makes the norm of
  /// the weighted residual small. Empty: all count the same.
  std::span<const double> residual_weights = {};

  [[nodiscard]] bool has_products() const { return products.whole != nullptr; }
  [[nodiscard]] std::int32_t num_velocities() const { return A.num_rows; }
  [[nodiscard]] std::int32_t num_pressures() const { return B.num_rows; }
  [[nodiscard]] std::int32_t size() const { return num_velocities() + num_pressures(); }
  [[nodiscard]] CsrView lower_left_block() const {
    CsrView block = B;
    if (!lower_left.empty()) block.values = lower_left;
    return block;
  }
  [[nodiscard]] SaddleSystem symmetric_part() const {
    SaddleSystem system = *this;
    system.lower_left = {};
    return system;
  }
};

/// A sparse matrix that owns its arrays.
struct CsrMatrix {
  std::int32_t num_columns = 0;
  std::vector<std::int32_t> row_start, columns;
  std::vector<double> values;
  [[nodiscard]] CsrView view() const {
    return {static_cast<std::int32_t>(row_start.size()) - 1, num_columns, row_start, columns,
            values};
  }
};
/// The whole system as one matrix [A Bᵀ; sB −sC], s = ±1, with its own lower left block. `pin` is
/// added to the diagonal entry −sC_00 as −s·pin.
[[nodiscard]] CsrMatrix merged_system(const SaddleSystem& system, double continuity_sign,
                                      double pin);

}  // namespace meniscus::linear
