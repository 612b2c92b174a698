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
  /// Whether the systems come with interpolations (quadratic velocities).
  bool multigrid_by_degree = false;
  /// Options as on PETSc's command line; they override the method's own. Prefixes: none for the
  /// outer solver, v_ for the velocity block's multigrid; by degree v_mg_levels_ for its smoother
  /// and v_mg_coarse_ for the algebraic part; p_ for the pressure mass matrix, where there is one;
  /// f_ for the direct method's factorisation.
  std::string petsc_options;
};

/// How a linear solve ended. That it did not converge is an outcome for the caller to answer.
struct [[nodiscard]] LinearReport {
  bool converged = false;
  std::string reason;  ///< PETSc's name for why it stopped, or its error message
  int iterations = 0;
  std::vector<double> residuals;  ///< norms by iteration, in the method's own norm
  double setup_seconds = 0.0, solve_seconds = 0.0;  ///< of this process's processor time
};

enum class Preconditioner { fresh, kept };

/// Solves saddle systems one after the other, keeping a preconditioner where asked to. Each process
/// of the communicator gives its part of the system, the right-hand side and the solution.
class SaddleSolver {
 public:
  SaddleSolver(Communicator communicator, SaddleOptions options);
  SaddleSolver(SaddleSolver&&) noexcept;
  SaddleSolver& operator=(SaddleSolver&&) noexcept;
  ~SaddleSolver();

  /// Solves for `solution` (starting from zero) until the residual is `rtol` times its first value
  /// (Euclidean norm; the preconditioner's norm with MINRES). `kept` takes the preconditioner of an
  /// earlier system, if there is one; this one must then be on the same sparsity. Collective.
  LinearReport solve(const SaddleSystem& system, std::span<const double> right_hand_side,
                     std::span<double> solution, double rtol,
                     Preconditioner preconditioner = Preconditioner::fresh);
  /// Makes and keeps the preconditioner that a fresh solve of this system would make. Collective.
  void prepare(const SaddleSystem& system);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meniscus::linear
