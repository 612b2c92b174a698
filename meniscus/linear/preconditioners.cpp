#include "meniscus/linear/preconditioners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"
#include "meniscus/linear/vector_arrays.hpp"

namespace meniscus::linear {

namespace {

void remove_mean(Communicator communicator, Vec vector) {
  PetscInt size = 0;
  petsc_check(VecGetLocalSize(vector, &size), "VecGetLocalSize");
  with_array(vector, [&](double* values) {
    const double total = sum(communicator, std::accumulate(values, values + size, 0.0));
    const double mean = total / double(sum(communicator, std::int64_t{size}));
    for (PetscInt i = 0; i < size; ++i) values[i] -= mean;
  });
}

}  // namespace

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
  const bool has_constants =
      std::ranges::any_of(system_.group_weights, [](double weight) { return weight != 0.0; });
  std::vector<double> constant(has_constants ? system_.group_weights.size() : 0, 0.0);
  for (std::size_t i = 0; !constant.empty() && i < r.size(); ++i)
    constant[static_cast<std::size_t>(system_.group_of_pressure[i])] += r[i];
  if (has_constants) sum(communicator_, constant);
  for (std::size_t g = 0; g < constant.size(); ++g) constant[g] *= s * system_.group_weights[g];
  with_array(z, [&](double* p) {
    for (std::size_t i = 0; !solver_ && i < r.size(); ++i)
      p[i] = s * r[i] / system_.pressure_mass[i];
    for (std::size_t i = 0; !constant.empty() && i < r.size(); ++i)
      p[i] += constant[static_cast<std::size_t>(system_.group_of_pressure[i])];
  });
}

PressureLaplacian::PressureLaplacian(Communicator communicator, const SaddleSystem& system)
    : communicator_(communicator), size_(system.num_pressures()) {
  // Of the diagonal: a singular matrix has a coarse level that cannot be factorised.
  constexpr double kShift = 1e-8;
  MPI_Comm comm = mpi_communicator(communicator);
  const Matrix B = copied_matrix(comm, system.divergence);
  std::vector<double> inverse(system.mass_diagonal.begin(), system.mass_diagonal.end());
  for (double& entry : inverse) entry = 1.0 / entry;
  Matrix scaled;
  petsc_check(MatTranspose(B.get(), MAT_INITIAL_MATRIX, scaled.out()), "MatTranspose");
  petsc_check(MatDiagonalScale(scaled.get(), borrowed_vector(comm, inverse).get(), nullptr),
              "MatDiagonalScale");
  petsc_check(MatMatMult(B.get(), scaled.get(), MAT_INITIAL_MATRIX, PETSC_DEFAULT, matrix_.out()),
              "MatMatMult");
  if (!system.C.row_start.empty())  // whose entries B's rows meet in
    petsc_check(
        MatAXPY(matrix_.get(), 1.0, borrowed_matrix(comm, system.C).get(), SUBSET_NONZERO_PATTERN),
        "MatAXPY");
  Vector diagonal;
  petsc_check(MatCreateVecs(matrix_.get(), diagonal.out(), nullptr), "MatCreateVecs");
  petsc_check(MatGetDiagonal(matrix_.get(), diagonal.get()), "MatGetDiagonal");
  petsc_check(VecScale(diagonal.get(), 1.0 + kShift), "VecScale");
  petsc_check(MatDiagonalSet(matrix_.get(), diagonal.get(), INSERT_VALUES), "MatDiagonalSet");
  petsc_check(KSPCreate(comm, cycle_.out()), "KSPCreate");
  petsc_check(KSPSetOptionsPrefix(cycle_.get(), "l_"), "KSPSetOptionsPrefix");
  petsc_check(KSPSetOperators(cycle_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
  petsc_check(KSPSetFromOptions(cycle_.get()), "KSPSetFromOptions");
  petsc_check(KSPSetUp(cycle_.get()), "KSPSetUp");
  result_ = zero_vector(comm, size_);
}

void PressureLaplacian::add(std::span<const double> r, double s, Vec z) const {
  const Vector right = borrowed_vector(mpi_communicator(communicator_), r);
  petsc_check(KSPSolve(cycle_.get(), right.get(), result_.get()), "KSPSolve");
  petsc_check(VecAXPY(z, s, result_.get()), "VecAXPY");
}

BlockPreconditioner::BlockPreconditioner(Communicator communicator, Shape shape,
                                         const SaddleSystem& system,
                                         const VelocityPreconditioner& multigrid, Mat B,
                                         const PressureLaplacian* pressure_laplacian,
                                         const CoarseSpace* slow_pressures)
    : communicator_(communicator),
      shape_(shape),
      system_(system),
      multigrid_(multigrid),
      B_(B),
      pressure_laplacian_(pressure_laplacian),
      slow_pressures_(slow_pressures),
      mass_(communicator, system),
      velocity_(zero_vector(mpi_communicator(communicator), system.num_velocities())),
      pressure_(zero_vector(mpi_communicator(communicator), system.num_pressures())) {}

void BlockPreconditioner::multiply_gradient() const {
  if (!system_.has_products()) {
    petsc_check(MatMultTranspose(B_, pressure_.get(), velocity_.get()), "MatMultTranspose");
    return;
  }
  with_arrays(pressure_.get(), velocity_.get(), [&](const double* p, double* v) {
    system_.products.gradient({p, std::size_t(system_.num_pressures())},
                              {v, std::size_t(system_.num_velocities())});
  });
}

void BlockPreconditioner::apply(Vec r, Vec z) const {
  const auto num_velocities = static_cast<std::size_t>(system_.num_velocities());
  const auto num_pressures = static_cast<std::size_t>(system_.num_pressures());
  const PetscScalar* residual = nullptr;
  petsc_check(VecGetArrayRead(r, &residual), "VecGetArrayRead");
  const std::span<const double> continuity(residual + num_velocities, num_pressures);
  const double sign = shape_ == Shape::diagonal ? 1.0 : -1.0;
  mass_.apply(continuity, sign, pressure_.get());
  if (pressure_laplacian_ != nullptr) pressure_laplacian_->add(continuity, sign, pressure_.get());
  if (slow_pressures_ != nullptr)
    with_array(pressure_.get(), [&](double* p) {
      slow_pressures_->add(continuity, sign, {p, num_pressures});
    });
  if (system_.constant_pressure_is_null) remove_mean(communicator_, pressure_.get());
  petsc_check(VecRestoreArrayRead(r, &residual), "VecRestoreArrayRead");
  if (shape_ == Shape::upper_triangular) multiply_gradient();
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
  multigrid_.apply(system_, velocity_.get(), z_velocity.get());
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
