#include "meniscus/linear/velocity_multigrid.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/vector_arrays.hpp"

namespace meniscus::linear {
namespace {

/// Number of Lanczos steps, and the factor by which the spectrum may exceed their estimate: PETSc's
/// defaults.
constexpr int kLanczosSteps = 10;
constexpr double kBeyondEstimate = 1.1;
/// The smoother treats the spectrum from this part of the estimate up, the coarse level the rest.
constexpr double kSmoothFrom = 0.1;

/// An estimate of the largest eigenvalue of D⁻¹A, D = diag A, A symmetric and positive definite. It
/// comes from Lanczos' method on D^(−½) A D^(−½), whose first vector is noise. PETSc's estimate
/// starts from D⁻¹ξ, which scales as 1/μ in a liquid of viscosity μ. If viscosities differ by 10⁴
/// it misses the spectrum of the more viscous liquid, and Chebyshev steps amplify the modes above
/// the estimate.
double largest_eigenvalue(MPI_Comm comm, Mat matrix, PCType scaling, const Vector& right) {
  KrylovSolver lanczos;
  petsc_check(KSPCreate(comm, lanczos.out()), "KSPCreate");
  petsc_check(KSPSetOperators(lanczos.get(), matrix, matrix), "KSPSetOperators");
  petsc_check(KSPSetType(lanczos.get(), KSPCG), "KSPSetType");
  PC pc = nullptr;
  petsc_check(KSPGetPC(lanczos.get(), &pc), "KSPGetPC");
  petsc_check(PCSetType(pc, scaling), "PCSetType");
  petsc_check(KSPSetNormType(lanczos.get(), KSP_NORM_NONE), "KSPSetNormType");
  petsc_check(
      KSPSetTolerances(lanczos.get(), PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, kLanczosSteps),
      "KSPSetTolerances");
  petsc_check(KSPSetComputeSingularValues(lanczos.get(), PETSC_TRUE),
              "KSPSetComputeSingularValues");
  Vector solution;
  petsc_check(VecDuplicate(right.get(), solution.out()), "VecDuplicate");
  petsc_check(KSPSolve(lanczos.get(), right.get(), solution.get()), "KSPSolve");
  PetscReal largest = 0.0, smallest = 0.0;
  petsc_check(KSPComputeExtremeSingularValues(lanczos.get(), &largest, &smallest),
              "KSPComputeExtremeSingularValues");
  return largest;
}

/// The same of a matrix with entries. The right-hand side D^½ξ makes Lanczos start from the noise
/// ξ.
double largest_jacobi_eigenvalue(MPI_Comm comm, Mat matrix) {
  Vector diagonal, noise;
  petsc_check(MatCreateVecs(matrix, noise.out(), diagonal.out()), "MatCreateVecs");
  petsc_check(MatGetDiagonal(matrix, diagonal.get()), "MatGetDiagonal");
  petsc_check(VecSqrtAbs(diagonal.get()), "VecSqrtAbs");
  petsc_check(VecSetRandom(noise.get(), nullptr), "VecSetRandom");
  petsc_check(VecPointwiseMult(noise.get(), noise.get(), diagonal.get()), "VecPointwiseMult");
  return largest_eigenvalue(comm, matrix, PCJACOBI, noise);
}

/// The same of an operator.
double largest_jacobi_eigenvalue(MPI_Comm comm, const LinearOperator& matrix,
                                 std::span<const double> diagonal) {
  std::vector<double> scaled(diagonal.size());
  const LinearOperator symmetric = [&](std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < x.size(); ++i) scaled[i] = x[i] / std::sqrt(diagonal[i]);
    matrix(scaled, y);
    for (std::size_t i = 0; i < x.size(); ++i) y[i] /= std::sqrt(diagonal[i]);
  };
  const auto size = static_cast<PetscInt>(diagonal.size());
  const Matrix shell = shell_matrix(comm, symmetric, size);
  const Vector noise = zero_vector(comm, size);
  petsc_check(VecSetRandom(noise.get(), nullptr), "VecSetRandom");
  return largest_eigenvalue(comm, shell.get(), PCNONE, noise);
}

/// Sets the bounds of the Chebyshev smoother of the finest level (options may choose another).
void bound_smoother(MPI_Comm comm, PC multigrid, Mat laplacian) {
  KSP smoother = nullptr;
  petsc_check(PCMGGetSmoother(multigrid, 1, &smoother), "PCMGGetSmoother");
  petsc_check(KSPSetType(smoother, KSPCHEBYSHEV), "KSPSetType");
  const double end = largest_jacobi_eigenvalue(comm, laplacian);
  petsc_check(KSPChebyshevSetEigenvalues(smoother, kBeyondEstimate * end, kSmoothFrom * end),
              "KSPChebyshevSetEigenvalues");
}

/// Sets up two levels, quadratic over linear functions. Options choose the solver of the coarse
/// level.
void use_interpolation(MPI_Comm comm, KSP cycle, Mat laplacian, const CsrView& interpolation) {
  PC pc = nullptr;
  petsc_check(KSPGetPC(cycle, &pc), "KSPGetPC");
  petsc_check(PCSetType(pc, PCMG), "PCSetType");
  petsc_check(PCMGSetLevels(pc, 2, nullptr), "PCMGSetLevels");
  petsc_check(PCMGSetGalerkin(pc, PC_MG_GALERKIN_BOTH), "PCMGSetGalerkin");
  petsc_check(PCMGSetInterpolation(pc, 1, copied_matrix(comm, interpolation).get()),
              "PCMGSetInterpolation");
  bound_smoother(comm, pc, laplacian);
}

KrylovSolver multigrid_cycle(MPI_Comm comm, Mat laplacian, const CsrView* interpolation) {
  KrylovSolver cycle;
  petsc_check(KSPCreate(comm, cycle.out()), "KSPCreate");
  petsc_check(KSPSetOptionsPrefix(cycle.get(), "v_"), "KSPSetOptionsPrefix");
  if (interpolation != nullptr) use_interpolation(comm, cycle.get(), laplacian, *interpolation);
  petsc_check(KSPSetOperators(cycle.get(), laplacian, laplacian), "KSPSetOperators");
  petsc_check(KSPSetFromOptions(cycle.get()), "KSPSetFromOptions");
  petsc_check(KSPSetUp(cycle.get()), "KSPSetUp");
  return cycle;
}

KrylovSolver coarse_cycle(MPI_Comm comm, Mat laplacian) {
  KrylovSolver cycle;
  petsc_check(KSPCreate(comm, cycle.out()), "KSPCreate");
  petsc_check(KSPSetOptionsPrefix(cycle.get(), "v_mg_coarse_"), "KSPSetOptionsPrefix");
  petsc_check(KSPSetOperators(cycle.get(), laplacian, laplacian), "KSPSetOperators");
  petsc_check(KSPSetFromOptions(cycle.get()), "KSPSetFromOptions");
  petsc_check(KSPSetUp(cycle.get()), "KSPSetUp");
  return cycle;
}

/// Component k of n vectors that stand one after the other, or into it.
void take_component(std::span<const double> vectors, std::size_t k, Vec component) {
  with_array(component, [&](double* to) {
    for (std::size_t i = 0; 3 * i < vectors.size(); ++i) to[i] = vectors[3 * i + k];
  });
}
void add_component(Vec component, std::size_t k, std::span<double> vectors) {
  const PetscScalar* from = nullptr;
  petsc_check(VecGetArrayRead(component, &from), "VecGetArrayRead");
  for (std::size_t i = 0; 3 * i < vectors.size(); ++i) vectors[3 * i + k] += from[i];
  petsc_check(VecRestoreArrayRead(component, &from), "VecRestoreArrayRead");
}

}  // namespace

VelocityMultigrid::VelocityMultigrid(Communicator communicator, const SaddleSystem& system)
    : num_nodes_(system.num_velocities() / 3),
      laplacian_of_(system.laplacian_of),
      component_r_(zero_vector(mpi_communicator(communicator), num_nodes_)),
      component_z_(zero_vector(mpi_communicator(communicator), num_nodes_)) {
  MENISCUS_ASSERT(
      system.interpolations.empty() || system.interpolations.size() == system.laplacians.size(),
      "{} interpolations, {} Laplacians", system.interpolations.size(), system.laplacians.size());
  MPI_Comm comm = mpi_communicator(communicator);
  for (std::size_t k = 0; k < system.laplacians.size(); ++k) {
    MENISCUS_ASSERT(system.laplacians[k].num_rows == num_nodes_, "{} {}",
                    system.laplacians[k].num_rows, num_nodes_);
    Matrix copy = copied_matrix(comm, system.laplacians[k]);
    cycles_.push_back(multigrid_cycle(
        comm, copy.get(), system.interpolations.empty() ? nullptr : &system.interpolations[k]));
    laplacians_.push_back(std::move(copy));
  }
}

void VelocityMultigrid::apply(const SaddleSystem&, Vec r, Vec z) const {
  const auto n = static_cast<std::size_t>(num_nodes_);
  for (std::size_t k = 0; k < 3; ++k) {
    with_arrays(r, component_r_.get(), [n, k](const double* from, double* to) {
      for (std::size_t i = 0; i < n; ++i) to[i] = from[3 * i + k];
    });
    MENISCUS_ASSERT(std::size_t(laplacian_of_[k]) < cycles_.size(), "component {}", k);
    const KrylovSolver& cycle = cycles_[static_cast<std::size_t>(laplacian_of_[k])];
    petsc_check(KSPSolve(cycle.get(), component_r_.get(), component_z_.get()), "KSPSolve");
    with_arrays(component_z_.get(), z, [n, k](const double* from, double* to) {
      for (std::size_t i = 0; i < n; ++i) to[3 * i + k] = from[i];
    });
  }
}

MultigridByDegree::MultigridByDegree(Communicator communicator, const SaddleSystem& system)
    : laplacian_of_(system.laplacian_of),
      smoothing_(system.laplacian_diagonals.begin(), system.laplacian_diagonals.end()),
      residual_(smoothing_.size()) {
  MENISCUS_ASSERT(smoothing_.size() == std::size_t(system.num_velocities()) &&
                      system.interpolations.size() == system.laplacians.size(),
                  "{} diagonal entries, {} interpolations, {} Laplacians", smoothing_.size(),
                  system.interpolations.size(), system.laplacians.size());
  MPI_Comm comm = mpi_communicator(communicator);
  // One Chebyshev step divides by the middle of its interval.
  const double middle =
      0.5 * (kBeyondEstimate + kSmoothFrom) *
      largest_jacobi_eigenvalue(comm, system.products.laplacians, system.laplacian_diagonals);
  for (double& entry : smoothing_) entry = 1.0 / (middle * entry);
  component_ = zero_vector(comm, system.num_velocities() / 3);
  coarse_r_ = zero_vector(comm, system.laplacians.front().num_rows);
  coarse_z_ = zero_vector(comm, system.laplacians.front().num_rows);
  for (std::size_t k = 0; k < system.laplacians.size(); ++k) {
    interpolations_.push_back(copied_matrix(comm, system.interpolations[k]));
    laplacians_.push_back(copied_matrix(comm, system.laplacians[k]));
    cycles_.push_back(coarse_cycle(comm, laplacians_.back().get()));
  }
}

/// A step of smoothing from zero, the coarse level's correction, and another step.
void MultigridByDegree::apply(const SaddleSystem& system, Vec r, Vec z) const {
  with_arrays(r, z, [&](const double* of, double* to) {
    const std::span<const double> given(of, smoothing_.size());
    const std::span<double> result(to, smoothing_.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = smoothing_[i] * given[i];
    find_residual(system, given, result);
    correct(result);
    find_residual(system, given, result);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += smoothing_[i] * residual_[i];
  });
}

void MultigridByDegree::find_residual(const SaddleSystem& system, std::span<const double> r,
                                      std::span<const double> z) const {
  system.products.laplacians(z, residual_);
  for (std::size_t i = 0; i < r.size(); ++i) residual_[i] = r[i] - residual_[i];
}

/// Adds what the linear functions make of the residual, component by component.
void MultigridByDegree::correct(std::span<double> z) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto which = static_cast<std::size_t>(laplacian_of_[k]);
    Mat interpolation = interpolations_[which].get();
    take_component(residual_, k, component_.get());
    petsc_check(MatMultTranspose(interpolation, component_.get(), coarse_r_.get()),
                "MatMultTranspose");
    petsc_check(KSPSolve(cycles_[which].get(), coarse_r_.get(), coarse_z_.get()), "KSPSolve");
    petsc_check(MatMult(interpolation, coarse_z_.get(), component_.get()), "MatMult");
    add_component(component_.get(), k, z);
  }
}

void WithSlowVelocities::apply(const SaddleSystem& system, Vec r, Vec z) const {
  cycle_->apply(system, r, z);
  const auto size = static_cast<std::size_t>(system.num_velocities());
  with_arrays(r, z, [&](const double* from, double* to) {
    slow_.add({from, size}, 1.0, {to, size});
  });
}

}  // namespace meniscus::linear
