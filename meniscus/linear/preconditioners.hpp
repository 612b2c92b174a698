#pragma once
// Only for the .cpp files of this room.

#include <array>
#include <vector>

#include "meniscus/linear/petsc_objects.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

/// One multigrid cycle per velocity component on a scalar μ-weighted Laplacian: spectrally close
/// to 2μ D:D by Korn's inequality, at a ninth of its entries. Keeps its own copy of the Laplacians.
class VelocityMultigrid {
 public:
  explicit VelocityMultigrid(const SaddleSystem& system);
  /// z = M⁻¹ r for the 3n velocities, components side by side.
  void apply(Vec r, Vec z) const;
  [[nodiscard]] std::int32_t num_nodes() const { return num_nodes_; }

 private:
  std::int32_t num_nodes_;
  std::array<int, 3> laplacian_of_;
  std::vector<Matrix> laplacians_;
  std::vector<KrylovSolver> cycles_;
  Vector component_r_, component_z_;
};

/// z_p = s (M_p/μ)⁻¹ r_p, z_v = M_A⁻¹ (r_v − Bᵀ z_p) (upper triangular, s = −1) or M_A⁻¹ r_v
/// (diagonal, s = +1, positive definite as MINRES needs it).
class BlockPreconditioner {
 public:
  enum class Shape { upper_triangular, diagonal };
  BlockPreconditioner(Shape shape, const SaddleSystem& system, const VelocityMultigrid& multigrid);
  void apply(Vec r, Vec z) const;

 private:
  Shape shape_;
  const SaddleSystem& system_;
  const VelocityMultigrid& multigrid_;
  Matrix B_;
  Vector velocity_, pressure_;
};

/// LDLᵀ by MUMPS of the merged system, one pressure pinned where the constant is a null vector.
class Factorization {
 public:
  explicit Factorization(const SaddleSystem& system);
  void apply(Vec r, Vec z) const;
  [[nodiscard]] std::int32_t size() const { return matrix_.num_columns; }

 private:
  CsrMatrix matrix_;
  Matrix handle_;
  KrylovSolver solver_;
};

/// z = D^(−½) r with D^½_ii = sqrt|J_ii| + 1e-6 (eq. 14 of hooper2001).
class DiagonalScaling {
 public:
  explicit DiagonalScaling(const CsrView& matrix);
  void apply(Vec r, Vec z) const;

 private:
  Vector root_;
};

}  // namespace meniscus::linear
