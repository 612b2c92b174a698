#include "meniscus/linear/multigrid_solver.hpp"

#include <algorithm>
#include <string>

#include "meniscus/core/error.hpp"
#include "meniscus/core/processor_time.hpp"
#include "meniscus/linear/petsc_matrix.hpp"
#include "meniscus/linear/saddle_options.hpp"

namespace meniscus::linear {

class MultigridSolver::Implementation {
 public:
  explicit Implementation(const CsrView& matrix) {
    MENISCUS_ASSERT(matrix.num_rows == matrix.num_columns, "{} rows, {} columns", matrix.num_rows,
                    matrix.num_columns);
    const double start = processor_seconds();
    try {
      start_petsc();
      set_up(matrix);
    } catch (const PetscFailure& failure) {  // the next solve reports the failure
      failure_ = failure.what();
    }
    setup_seconds_ = processor_seconds() - start;
  }

  LinearReport solve(std::span<const double> right_hand_side, std::span<double> solution,
                     double rtol, int max_iterations) const {
    LinearReport report;
    report.setup_seconds = setup_seconds_;
    std::ranges::fill(solution, 0.0);
    report.reason = failure_;
    if (!failure_.empty()) return report;
    const double start = processor_seconds();
    try {
      iterate(right_hand_side, solution, rtol, max_iterations, report);
    } catch (const PetscFailure& failure) {
      report.reason = failure.what();
    }
    report.solve_seconds = processor_seconds() - start;
    return report;
  }

 private:
  void set_up(const CsrView& matrix) {
    petsc_check(PetscOptionsCreate(table_.out()), "PetscOptionsCreate");
    std::string options = "-ksp_type cg" + multigrid_options("", has_hypre());
    if (has_hypre()) options += aggressive_coarsening("");
    petsc_check(PetscOptionsInsertString(table_.get(), options.c_str()),
                "PetscOptionsInsertString");
    const OptionScope scope(table_.get());
    matrix_ = borrowed_matrix(PETSC_COMM_SELF, matrix);
    petsc_check(KSPCreate(PETSC_COMM_SELF, solver_.out()), "KSPCreate");
    petsc_check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
    petsc_check(KSPSetFromOptions(solver_.get()), "KSPSetFromOptions");
    petsc_check(KSPSetNormType(solver_.get(), KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
    petsc_check(KSPSetUp(solver_.get()), "KSPSetUp");
  }

  void iterate(std::span<const double> right_hand_side, std::span<double> solution, double rtol,
               int max_iterations, LinearReport& report) const {
    const Vector b = borrowed_vector(PETSC_COMM_SELF, right_hand_side),
                 x = borrowed_vector(PETSC_COMM_SELF, solution);
    petsc_check(KSPSetTolerances(solver_.get(), rtol, 1e-300, PETSC_DEFAULT, max_iterations),
                "KSPSetTolerances");
    petsc_check(KSPSolve(solver_.get(), b.get(), x.get()), "KSPSolve");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    petsc_check(KSPGetConvergedReason(solver_.get(), &reason), "KSPGetConvergedReason");
    petsc_check(KSPGetIterationNumber(solver_.get(), &iterations), "KSPGetIterationNumber");
    report.converged = reason > 0;
    report.reason = KSPConvergedReasons[reason];
    report.iterations = iterations;
  }

  OptionTable table_;
  Matrix matrix_;
  KrylovSolver solver_;
  std::string failure_;
  double setup_seconds_ = 0.0;
};

MultigridSolver::MultigridSolver(const CsrView& matrix)
    : implementation_(std::make_unique<Implementation>(matrix)) {}
MultigridSolver::~MultigridSolver() = default;

LinearReport MultigridSolver::solve(std::span<const double> right_hand_side,
                                    std::span<double> solution, double rtol,
                                    int max_iterations) const {
  return implementation_->solve(right_hand_side, solution, rtol, max_iterations);
}

}  // namespace meniscus::linear
