#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "meniscus/linear/communicator.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

enum class SaddleMethod {
  block,        ///< FGMRES, block upper triangular: multigrid on scalar Laplacians, lumped mass
  paper_gmres,  ///< GMRES(100), right scaling by D^½ = |J_ii|^½ + 1e-6 (eq. 14 of hooper2001)
  minres,       ///< MINRES, block diagonal with the same blocks
  mumps,        ///< FGMRES preconditioned by a sparse LDLᵀ factorisation
};
[[nodiscard]] std::string name(SaddleMethod method);

struct SaddleOptions {
  SaddleMethod method = SaddleMethod::block;
  int max_iterations = 2000;
  /// Whether systems have `interpolations` (quadratic velocities).
  bool multigrid_by_degree = false;
  /// Options as on PETSc's command line, which override the defaults of the method.
  /// Prefixes: none for the outer solver; v_ for the velocity block's multigrid; p_ for
  /// the consistent pressure mass matrix; l_ for the pressure Laplacian. The
  /// factorisation of the direct method has f_. Multigrid by degree has v_mg_coarse_ for
  /// the algebraic part and, where the system has matrices, v_mg_levels_ for the
  /// smoother.
  std::string petsc_options;
};

/// The outcome of a linear solve. The caller must handle a solve that did not converge.
struct [[nodiscard]] LinearReport {
  bool converged = false;
  std::string reason;  ///< PETSc's name for why it stopped, or its error message
  int iterations = 0;
  std::vector<double> residuals;  ///< residual norms by iteration, in the norm of the method
  double setup_seconds = 0.0, solve_seconds = 0.0;  ///< processor time of this process
};

enum class Preconditioner { fresh, kept };

/// Solves a sequence of saddle systems and may keep a preconditioner. Each process of the
/// communicator passes its part of the system, the right-hand side and the solution.
class SaddleSolver {
 public:
  SaddleSolver(Communicator communicator, SaddleOptions options);
  SaddleSolver(SaddleSolver&&) noexcept;
  SaddleSolver& operator=(SaddleSolver&&) noexcept;
  ~SaddleSolver();

  /// Solves for `solution`, starting from zero, until the residual is `rtol` times its first value
  /// (Euclidean norm, by the system's weights if it has some; with MINRES the preconditioner's
  /// norm). `kept` reuses the preconditioner of an earlier system with the same sparsity, if there
  /// is one. Collective.
  LinearReport solve(const SaddleSystem& system, std::span<const double> right_hand_side,
                     std::span<double> solution, double rtol,
                     Preconditioner preconditioner = Preconditioner::fresh);
  /// Makes and keeps the preconditioner of this system. Collective.
  void prepare(const SaddleSystem& system);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meniscus::linear
