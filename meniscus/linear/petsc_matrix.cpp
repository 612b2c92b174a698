#include "meniscus/linear/petsc_matrix.hpp"

#include <array>
#include <cmath>
#include <type_traits>

namespace meniscus::linear {

static_assert(std::is_same_v<PetscScalar, double>, "PETSc must be built for real double numbers");
static_assert(std::is_same_v<PetscInt, std::int32_t>, "PETSc must be built with 32-bit indices");

Matrix borrowed_matrix(const CsrView& csr) {
  Matrix matrix;
  // PETSc's interface is not const-correct: it neither writes nor frees these arrays.
  petsc_check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, csr.num_rows, csr.num_columns,
                                        const_cast<PetscInt*>(csr.row_start.data()),
                                        const_cast<PetscInt*>(csr.columns.data()),
                                        const_cast<PetscScalar*>(csr.values.data()), matrix.out()),
              "MatCreateSeqAIJWithArrays");
  return matrix;
}

Vector zero_vector(PetscInt size) {
  Vector vector;
  petsc_check(VecCreateSeq(PETSC_COMM_SELF, size, vector.out()), "VecCreateSeq");
  petsc_check(VecSet(vector.get(), 0.0), "VecSet");
  return vector;
}

Vector borrowed_vector(std::span<const double> values) {
  Vector vector;
  petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(values.size()),
                                    values.data(), vector.out()),
              "VecCreateSeqWithArray");
  return vector;
}

Matrix nested_operator(const SaddleSystem& system) {
  const Matrix A = borrowed_matrix(system.A), B = borrowed_matrix(system.B);
  Matrix C = borrowed_matrix(system.C), gradient, minus_C, nest;
  petsc_check(MatCreateTranspose(B.get(), gradient.out()), "MatCreateTranspose");
  petsc_check(MatDuplicate(C.get(), MAT_COPY_VALUES, minus_C.out()), "MatDuplicate");
  petsc_check(MatScale(minus_C.get(), -1.0), "MatScale");
  std::array<Mat, 4> blocks = {A.get(), gradient.get(), B.get(), minus_C.get()};
  petsc_check(MatCreateNest(PETSC_COMM_SELF, 2, nullptr, 2, nullptr, blocks.data(), nest.out()),
              "MatCreateNest");
  return nest;
}

void attach_constant_pressure(Mat matrix, std::int32_t num_velocities, std::int32_t num_pressures) {
  const Vector constant = zero_vector(num_velocities + num_pressures);
  PetscScalar* values = nullptr;
  petsc_check(VecGetArray(constant.get(), &values), "VecGetArray");
  for (std::int32_t i = 0; i < num_pressures; ++i)
    values[num_velocities + i] = 1.0 / std::sqrt(static_cast<double>(num_pressures));
  petsc_check(VecRestoreArray(constant.get(), &values), "VecRestoreArray");
  std::array<Vec, 1> vectors = {constant.get()};
  NullSpace space;
  petsc_check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, 1, vectors.data(), space.out()),
              "MatNullSpaceCreate");
  petsc_check(MatSetNullSpace(matrix, space.get()), "MatSetNullSpace");
  petsc_check(MatSetTransposeNullSpace(matrix, space.get()), "MatSetTransposeNullSpace");
}

}  // namespace meniscus::linear
