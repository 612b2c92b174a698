#pragma once
// Private header of this room.

#include <span>
#include <vector>

#include "meniscus/linear/velocity_multigrid.hpp"

namespace meniscus::linear {

// All functions are collective, like PETSc's preconditioners.

/// An approximate solve with the pressure mass matrix, lumped or consistent.
class PressureMass {
 public:
  /// The system must outlive this.
  PressureMass(Communicator communicator, const SaddleSystem& system);
  /// z = s M⁻¹ r.
  void apply(std::span<const double> r, double s, Vec z) const;

 private:
  Communicator communicator_;
  const SaddleSystem& system_;
  Matrix matrix_;
  KrylovSolver solver_;  ///< empty for the lumped matrix
};

/// An algebraic multigrid cycle on B diag(M)⁻¹ Bᵀ + C, of which it keeps a copy.
class PressureLaplacian {
 public:
  PressureLaplacian(Communicator communicator, const SaddleSystem& system);
  /// Adds s (B diag(M)⁻¹ Bᵀ + C)⁻¹ r to z.
  void add(std::span<const double> r, double s, Vec z) const;
  [[nodiscard]] std::int32_t size() const { return size_; }

 private:
  Communicator communicator_;
  std::int32_t size_;
  Matrix matrix_;
  KrylovSolver cycle_;
  Vector result_;
};

/// S⁻¹ = (M_p/μ)⁻¹ + L⁻¹ with a pressure Laplacian L, else (M_p/μ)⁻¹. The coarse space of the slow
/// pressures is added, if there are such; z_p = s S⁻¹ r_p. Upper triangular, s = −1: z_v = M_A⁻¹
/// (r_v − Bᵀ z_p). Diagonal, s = +1, positive definite as MINRES needs it: z_v = M_A⁻¹ r_v.
class BlockPreconditioner {
 public:
  enum class Shape { upper_triangular, diagonal };
  /// All that is given must outlive this. B is null where there are products, the pressure
  /// Laplacian where there are no masses, the slow pressures where there are none.
  BlockPreconditioner(Communicator communicator, Shape shape, const SaddleSystem& system,
                      const VelocityPreconditioner& multigrid, Mat B,
                      const PressureLaplacian* pressure_laplacian,
                      const CoarseSpace* slow_pressures);
  void apply(Vec r, Vec z) const;

 private:
  /// The pressure's part of the momentum, of `pressure_` into `velocity_`.
  void multiply_gradient() const;

  Communicator communicator_;
  Shape shape_;
  const SaddleSystem& system_;
  const VelocityPreconditioner& multigrid_;
  Mat B_;
  const PressureLaplacian* pressure_laplacian_;
  const CoarseSpace* slow_pressures_;
  PressureMass mass_;
  Vector velocity_, pressure_;
};

/// LDLᵀ by MUMPS of the merged system, one pressure pinned where the constant is a null vector.
class Factorization {
 public:
  Factorization(Communicator communicator, const SaddleSystem& system);
  void apply(Vec r, Vec z) const;
  /// The size of the system on this rank.
  [[nodiscard]] std::int32_t size() const { return size_; }

 private:
  std::int32_t size_;
  MergedMatrix matrix_;
  KrylovSolver solver_;
};

/// z = D^(−½) r with D^½_ii = sqrt|J_ii| + 1e-6 (eq. 14 of hooper2001).
class DiagonalScaling {
 public:
  explicit DiagonalScaling(Mat matrix);
  void apply(Vec r, Vec z) const;

 private:
  Vector root_;
};

}  // namespace meniscus::linear
