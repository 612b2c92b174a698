#include "meniscus/linear/preconditioners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::linear {
namespace {

/// Applies `action(reading, writing)` to the raw arrays of two vectors.
template <class Action>
void with_arrays(Vec from, Vec to, Action action) {
  const PetscScalar* reading = nullptr;
  PetscScalar* writing = nullptr;
  petsc_check(VecGetArrayRead(from, &reading), "VecGetArrayRead");
  petsc_check(VecGetArray(to, &writing), "VecGetArray");
  action(reading, writing);
  petsc_check(VecRestoreArray(to, &writing), "VecRestoreArray");
  petsc_check(VecRestoreArrayRead(from, &reading), "VecRestoreArrayRead");
}

template <class Action>
void with_array(Vec of, Action action) {
  PetscScalar* values = nullptr;
  petsc_check(VecGetArray(of, &values), "VecGetArray");
  action(values);
  petsc_check(VecRestoreArray(of, &values), "VecRestoreArray");
}

/// Number of Lanczos steps, and the factor by which the spectrum may exceed their estimate: PETSc's
/// defaults.
constexpr int kLanczosSteps = 10;
constexpr double kBeyondEstimate = 1.1;

/// A right-hand side D^½ξ with noise ξ, so that Lanczos on D^(−½) A D^(−½) starts from ξ.
Vector weighted_noise(Mat matrix) {
  Vector diagonal, noise;
  petsc_check(MatCreateVecs(matrix, noise.out(), diagonal.out()), "MatCreateVecs");
  petsc_check(MatGetDiagonal(matrix, diagonal.get()), "MatGetDiagonal");
  petsc_check(VecSqrtAbs(diagonal.get()), "VecSqrtAbs");
  petsc_check(VecSetRandom(noise.get(), nullptr), "VecSetRandom");
  petsc_check(VecPointwiseMult(noise.get(), noise.get(), diagonal.get()), "VecPointwiseMult");
  return noise;
}

/// An estimate of the largest eigenvalue of D⁻¹A, D = diag A, for a symmetric positive definite A.
/// PETSc's estimate starts from D⁻¹ξ, which scales as 1/μ in a liquid of viscosity μ. If
/// viscosities differ by 10⁴ it misses the spectrum of the more viscous liquid, and Chebyshev steps
/// amplify the modes above the estimate.
double largest_jacobi_eigenvalue(MPI_Comm comm, Mat matrix) {
  KrylovSolver lanczos;
  petsc_check(KSPCreate(comm, lanczos.out()), "KSPCreate");
  petsc_check(KSPSetOperators(lanczos.get(), matrix, matrix), "KSPSetOperators");
  petsc_check(KSPSetType(lanczos.get(), KSPCG), "KSPSetType");
  PC pc = nullptr;
  petsc_check(KSPGetPC(lanczos.get(), &pc), "KSPGetPC");
  petsc_check(PCSetType(pc, PCJACOBI), "PCSetType");
  petsc_check(KSPSetNormType(lanczos.get(), KSP_NORM_NONE), "KSPSetNormType");
  petsc_check(
      KSPSetTolerances(lanczos.get(), PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, kLanczosSteps),
      "KSPSetTolerances");
  petsc_check(KSPSetComputeSingularValues(lanczos.get(), PETSC_TRUE),
              "KSPSetComputeSingularValues");
  const Vector right = weighted_noise(matrix);
  Vector solution;
  petsc_check(VecDuplicate(right.get(), solution.out()), "VecDuplicate");
  petsc_check(KSPSolve(lanczos.get(), right.get(), solution.get()), "KSPSolve");
  PetscReal largest = 0.0, smallest = 0.0;
  petsc_check(KSPComputeExtremeSingularValues(lanczos.get(), &largest, &smallest),
              "KSPComputeExtremeSingularValues");
  return largest;
}

/// Sets the bounds of the Chebyshev smoother of the finest level (options may choose another): from
/// a tenth of the largest eigenvalue up, the part that the coarse level does not treat.
void bound_smoother(MPI_Comm comm, PC multigrid, Mat laplacian) {
  KSP smoother = nullptr;
  petsc_check(PCMGGetSmoother(multigrid, 1, &smoother), "PCMGGetSmoother");
  petsc_check(KSPSetType(smoother, KSPCHEBYSHEV), "KSPSetType");
  const double end = largest_jacobi_eigenvalue(comm, laplacian);
  petsc_check(KSPChebyshevSetEigenvalues(smoother, kBeyondEstimate * end, 0.1 * end),
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

void VelocityMultigrid::apply(Vec r, Vec z) const {
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

PressureMass::PressureMass(Communicator communicator, const SaddleSystem& system)
    : communicator_(communicator), system_(system) {
  if (system.consistent_mass.num_rows == 0) return;
  MPI_Comm comm = mpi_communicator(communicator);
  matrix_ = borrowed_matrix(comm, system.consistent_mass);
  petsc_check(KSPCreate(comm, solver_.out()), "KSPCreate");
  petsc_check(KSPSetOptionsPrefix(solver_.get(), "p_"), "KSPSetOptionsPrefix");
  petsc_check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
  petsc_check(KSPSetFromOptions(solver_.get()), "KSPSetFromOptions");
  petsc_check(KSPSetUp(solver_.get()), "KSPSetUp");
}

void PressureMass::apply(std::span<const double> r, double s, Vec z) const {
  MENISCUS_ASSERT(r.size() == std::size_t(system_.num_pressures()), "{} {}", r.size(),
                  system_.num_pressures());
  if (solver_) {
    const Vector right = borrowed_vector(mpi_communicator(communicator_), r);
    petsc_check(KSPSolve(solver_.get(), right.get(), z), "KSPSolve");
    petsc_check(VecScale(z, s), "VecScale");
  }
  std::vector<double> constant(system_.group_weights.size(), 0.0);
  for (std::size_t i = 0; !constant.empty() && i < r.size(); ++i)
    constant[static_cast<std::size_t>(system_.group_of_pressure[i])] += r[i];
  for (std::size_t g = 0; g < constant.size(); ++g)
    constant[g] = s * system_.group_weights[g] * sum(communicator_, constant[g]);
  with_array(z, [&](double* p) {
    for (std::size_t i = 0; !solver_ && i < r.size(); ++i)
      p[i] = s * r[i] / system_.pressure_mass[i];
    for (std::size_t i = 0; !constant.empty() && i < r.size(); ++i)
      p[i] += constant[static_cast<std::size_t>(system_.group_of_pressure[i])];
    if (!system_.constant_pressure_is_null) return;
    const double total = sum(communicator_, std::accumulate(p, p + r.size(), 0.0));
    const double mean = total / double(sum(communicator_, std::int64_t{system_.num_pressures()}));
    for (std::size_t i = 0; i < r.size(); ++i) p[i] -= mean;
  });
}

BlockPreconditioner::BlockPreconditioner(Communicator communicator, Shape shape,
                                         const SaddleSystem& system,
                                         const VelocityMultigrid& multigrid, Mat B)
    : communicator_(communicator),
      shape_(shape),
      system_(system),
      multigrid_(multigrid),
      B_(B),
      mass_(communicator, system),
      velocity_(zero_vector(mpi_communicator(communicator), system.num_velocities())),
      pressure_(zero_vector(mpi_communicator(communicator), system.num_pressures())) {}

void BlockPreconditioner::apply(Vec r, Vec z) const {
  const auto num_velocities = static_cast<std::size_t>(system_.num_velocities());
  const auto num_pressures = static_cast<std::size_t>(system_.num_pressures());
  const PetscScalar* residual = nullptr;
  petsc_check(VecGetArrayRead(r, &residual), "VecGetArrayRead");
  mass_.apply({residual + num_velocities, num_pressures}, shape_ == Shape::diagonal ? 1.0 : -1.0,
              pressure_.get());
  petsc_check(VecRestoreArrayRead(r, &residual), "VecRestoreArrayRead");
  if (shape_ == Shape::upper_triangular)
    petsc_check(MatMultTranspose(B_, pressure_.get(), velocity_.get()), "MatMultTranspose");
  with_arrays(r, velocity_.get(), [&](const double* from, double* v) {
    const double keep = shape_ == Shape::upper_triangular ? 1.0 : 0.0;
    for (std::size_t i = 0; i < num_velocities; ++i) v[i] = from[i] - keep * v[i];
  });
  const Vector z_velocity = [&] {
    const PetscScalar* values = nullptr;
    petsc_check(VecGetArrayRead(z, &values), "VecGetArrayRead");
    Vector part = borrowed_vector(mpi_communicator(communicator_), {values, num_velocities});
    petsc_check(VecRestoreArrayRead(z, &values), "VecRestoreArrayRead");
    return part;
  }();
  multigrid_.apply(velocity_.get(), z_velocity.get());
  with_arrays(pressure_.get(), z, [&](const double* p, double* to) {
    std::copy(p, p + num_pressures, to + num_velocities);
  });
}

Factorization::Factorization(Communicator communicator, const SaddleSystem& system)
    : size_(system.size()),
      matrix_(
          merged_matrix(mpi_communicator(communicator), system.symmetric_part(), 1.0,
                        system.constant_pressure_is_null ? system.pressure_mass.front() : 0.0)) {
  Mat handle = matrix_.handle.get();
  petsc_check(MatSetOption(handle, MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
  petsc_check(MatSetOptionsPrefix(handle, "f_"), "MatSetOptionsPrefix");
  petsc_check(KSPCreate(mpi_communicator(communicator), solver_.out()), "KSPCreate");
  petsc_check(KSPSetOptionsPrefix(solver_.get(), "f_"), "KSPSetOptionsPrefix");
  petsc_check(KSPSetOperators(solver_.get(), handle, handle), "KSPSetOperators");
  petsc_check(KSPSetFromOptions(solver_.get()), "KSPSetFromOptions");
  petsc_check(KSPSetUp(solver_.get()), "KSPSetUp");
  PCFailedReason failure = PC_NOERROR;
  PC pc = nullptr;
  petsc_check(KSPGetPC(solver_.get(), &pc), "KSPGetPC");
  petsc_check(PCGetFailedReason(pc, &failure), "PCGetFailedReason");
  if (failure != PC_NOERROR) throw PetscFailure("the factorisation failed: singular block");
}

void Factorization::apply(Vec r, Vec z) const {
  petsc_check(KSPSolve(solver_.get(), r, z), "KSPSolve");
}

DiagonalScaling::DiagonalScaling(Mat matrix) {
  petsc_check(MatCreateVecs(matrix, root_.out(), nullptr), "MatCreateVecs");
  petsc_check(MatGetDiagonal(matrix, root_.get()), "MatGetDiagonal");
  PetscInt size = 0;
  petsc_check(VecGetLocalSize(root_.get(), &size), "VecGetLocalSize");
  PetscScalar* root = nullptr;
  petsc_check(VecGetArray(root_.get(), &root), "VecGetArray");
  for (PetscInt i = 0; i < size; ++i) root[i] = std::sqrt(std::abs(root[i])) + 1e-6;  // ε of eq. 14
  petsc_check(VecRestoreArray(root_.get(), &root), "VecRestoreArray");
}

void DiagonalScaling::apply(Vec r, Vec z) const {
  petsc_check(VecPointwiseDivide(z, r, root_.get()), "VecPointwiseDivide");
}

}  // namespace meniscus::linear
