#pragma once
// Private header of this room.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "meniscus/linear/coarse_space.hpp"
#include "meniscus/linear/petsc_matrix.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

// All functions are collective, like PETSc's preconditioners.

/// One multigrid cycle per velocity component on a scalar μ-weighted Laplacian. By Korn's
/// inequality it is spectrally equivalent to 2μ D:D, with a ninth of the entries.
class VelocityPreconditioner {
 public:
  VelocityPreconditioner() = default;
  VelocityPreconditioner(const VelocityPreconditioner&) = delete;
  VelocityPreconditioner& operator=(const VelocityPreconditioner&) = delete;
  virtual ~VelocityPreconditioner() = default;
  /// z = M⁻¹ r for the 3n velocities, the three components of a node side by side. The system is
  /// the one that is being solved, of the same sparsity as that which the preconditioner was made
  /// of.
  virtual void apply(const SaddleSystem& system, Vec r, Vec z) const = 0;
  [[nodiscard]] virtual std::int32_t num_nodes() const = 0;
};

/// By matrices, of which it keeps a copy; whatever PETSc's options ask for.
class VelocityMultigrid final : public VelocityPreconditioner {
 public:
  VelocityMultigrid(Communicator communicator, const SaddleSystem& system);
  void apply(const SaddleSystem& system, Vec r, Vec z) const override;
  [[nodiscard]] std::int32_t num_nodes() const override { return num_nodes_; }

 private:
  std::int32_t num_nodes_;
  std::array<int, 3> laplacian_of_;
  std::vector<Matrix> laplacians_;
  std::vector<KrylovSolver> cycles_;
  Vector component_r_, component_z_;
};

/// Two levels, quadratic over linear functions, for systems given by products. There is a step of
/// Chebyshev–Jacobi smoothing before and after an algebraic cycle on the linear functions. Keeps
/// the coarse level and the smoother's weights; residuals are by the system's own products.
class MultigridByDegree final : public VelocityPreconditioner {
 public:
  MultigridByDegree(Communicator communicator, const SaddleSystem& system);
  void apply(const SaddleSystem& system, Vec r, Vec z) const override;
  [[nodiscard]] std::int32_t num_nodes() const override {
    return static_cast<std::int32_t>(smoothing_.size() / 3);
  }

 private:
  void find_residual(const SaddleSystem& system, std::span<const double> r,
                     std::span<const double> z) const;
  void correct(std::span<double> z) const;

  std::array<int, 3> laplacian_of_;
  std::vector<double> smoothing_;  ///< what a step multiplies the residual by
  std::vector<Matrix> interpolations_, laplacians_;
  std::vector<KrylovSolver> cycles_;
  mutable std::vector<double> residual_;
  Vector component_, coarse_r_, coarse_z_;
};

/// Another preconditioner with the coarse space of the slow velocities added.
class WithSlowVelocities final : public VelocityPreconditioner {
 public:
  WithSlowVelocities(std::unique_ptr<VelocityPreconditioner> cycle, CoarseSpace slow)
      : cycle_(std::move(cycle)), slow_(std::move(slow)) {}
  void apply(const SaddleSystem& system, Vec r, Vec z) const override;
  [[nodiscard]] std::int32_t num_nodes() const override { return cycle_->num_nodes(); }

 private:
  std::unique_ptr<VelocityPreconditioner> cycle_;
  CoarseSpace slow_;
};

}  // namespace meniscus::linear
