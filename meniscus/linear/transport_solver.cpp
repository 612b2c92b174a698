#include "meniscus/linear/transport_solver.hpp"

#include <string>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/petsc_matrix.hpp"
#include "meniscus/linear/saddle_options.hpp"

namespace meniscus::linear {
namespace {

/// No rows of these matrices have the same columns, so that PETSc need not look for any.
std::string options_of(ScalarSystem kind) {
  switch (kind) {
    case ScalarSystem::transport:
      // It keeps the preconditioned directions, so that none is found again at the end.
      return "-ksp_type fgmres -ksp_gmres_restart 60 -pc_type sor -pc_sor_forward -mat_no_inode";
    case ScalarSystem::conduction:
      return "-ksp_type gmres -ksp_gmres_restart 60 -ksp_pc_side right" +
             multigrid_options("", has_hypre());
    case ScalarSystem::potential:
      break;
  }
  return "-ksp_type cg -pc_type sor -pc_sor_symmetric -mat_no_inode";
}

}  // namespace

class TransportSolver::Implementation {
 public:
  Implementation(const CsrView& matrix, ScalarSystem kind) {
    MENISCUS_ASSERT(matrix.num_rows == matrix.num_columns, "{} rows, {} columns", matrix.num_rows,
                    matrix.num_columns);
    try {
      start_petsc();
      set_up(matrix, kind);
    } catch (const PetscFailure& failure) {  // the next solve reports the failure
      failure_ = failure.what();
    }
  }

  LinearReport solve(std::span<const double> right_hand_side, std::span<double> solution,
                     double rtol, int max_iterations) const {
    LinearReport report;
    report.reason = failure_;
    if (!failure_.empty()) return report;
    try {
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
    } catch (const PetscFailure& failure) {
      report.reason = failure.what();
    }
    return report;
  }

 private:
  void set_up(const CsrView& matrix, ScalarSystem kind) {
    petsc_check(PetscOptionsCreate(table_.out()), "PetscOptionsCreate");
    petsc_check(PetscOptionsInsertString(table_.get(), options_of(kind).c_str()),
                "PetscOptionsInsertString");
    const OptionScope scope(table_.get());
    matrix_ = borrowed_matrix(PETSC_COMM_SELF, matrix);
    petsc_check(KSPCreate(PETSC_COMM_SELF, solver_.out()), "KSPCreate");
    petsc_check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
    petsc_check(KSPSetFromOptions(solver_.get()), "KSPSetFromOptions");
    petsc_check(KSPSetNormType(solver_.get(), KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
    petsc_check(KSPSetInitialGuessNonzero(solver_.get(), PETSC_TRUE), "KSPSetInitialGuessNonzero");
    petsc_check(KSPSetUp(solver_.get()), "KSPSetUp");
  }

  OptionTable table_;
  Matrix matrix_;
  KrylovSolver solver_;
  std::string failure_;
};

TransportSolver::TransportSolver(const CsrView& matrix, ScalarSystem kind)
    : implementation_(std::make_unique<Implementation>(matrix, kind)) {}
TransportSolver::~TransportSolver() = default;

LinearReport TransportSolver::solve(std::span<const double> right_hand_side,
                                    std::span<double> solution, double rtol,
                                    int max_iterations) const {
  return implementation_->solve(right_hand_side, solution, rtol, max_iterations);
}

}  // namespace meniscus::linear
