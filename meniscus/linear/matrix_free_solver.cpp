#include "meniscus/linear/matrix_free_solver.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/core/processor_time.hpp"
#include "meniscus/linear/petsc_matrix.hpp"
#include "meniscus/linear/petsc_objects.hpp"

namespace meniscus::linear {
namespace {

KrylovSolver gmres(const Matrix& matrix, const MatrixFreeOptions& options) {
  KrylovSolver solver;
  petsc_check(KSPCreate(PETSC_COMM_SELF, solver.out()), "KSPCreate");
  petsc_check(KSPSetOperators(solver.get(), matrix.get(), matrix.get()), "KSPSetOperators");
  petsc_check(KSPSetType(solver.get(), KSPGMRES), "KSPSetType");
  petsc_check(KSPGMRESSetRestart(solver.get(), options.restart), "KSPGMRESSetRestart");
  petsc_check(KSPSetInitialGuessNonzero(solver.get(), PETSC_TRUE), "KSPSetInitialGuessNonzero");
  petsc_check(
      KSPSetTolerances(solver.get(), options.rtol, 1e-300, PETSC_DEFAULT, options.max_iterations),
      "KSPSetTolerances");
  PC pc = nullptr;
  petsc_check(KSPGetPC(solver.get(), &pc), "KSPGetPC");
  petsc_check(PCSetType(pc, PCNONE), "PCSetType");
  return solver;
}

}  // namespace

LinearReport solve_matrix_free(const LinearOperator& matrix,
                               std::span<const double> right_hand_side, std::span<double> solution,
                               const MatrixFreeOptions& options) {
  MENISCUS_ASSERT(right_hand_side.size() == solution.size(), "{} {}", right_hand_side.size(),
                  solution.size());
  LinearReport report;
  const double start = processor_seconds();
  try {
    start_petsc();
    const Matrix operator_matrix =
        shell_matrix(PETSC_COMM_SELF, matrix, static_cast<PetscInt>(solution.size()));
    const Vector b = borrowed_vector(PETSC_COMM_SELF, right_hand_side),
                 x = borrowed_vector(PETSC_COMM_SELF, solution);
    const KrylovSolver solver = gmres(operator_matrix, options);
    petsc_check(KSPSolve(solver.get(), b.get(), x.get()), "KSPSolve");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    petsc_check(KSPGetConvergedReason(solver.get(), &reason), "KSPGetConvergedReason");
    petsc_check(KSPGetIterationNumber(solver.get(), &iterations), "KSPGetIterationNumber");
    report.converged = reason > 0;
    report.reason = KSPConvergedReasons[reason];
    report.iterations = iterations;
  } catch (const PetscFailure& failure) {
    report.reason = failure.what();
  }
  report.solve_seconds = processor_seconds() - start;
  return report;
}

}  // namespace meniscus::linear
