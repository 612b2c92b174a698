#include "meniscus/linear/petsc_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <type_traits>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::linear {

static_assert(std::is_same_v<PetscScalar, double>, "PETSc must be built for real double numbers");
static_assert(std::is_same_v<PetscInt, std::int32_t>, "PETSc must be built with 32-bit indices");

namespace {

using Container = Owned<PetscContainer, PetscContainerDestroy>;

bool is_shared(MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size > 1;
}

/// The rows of a distributed matrix as PETSc keeps them: owned columns with local numbers, and
/// ghost columns, in separate arrays.
struct SplitRows {
  struct Part {
    std::vector<PetscInt> start = {0};
    std::unique_ptr<PetscInt[]> columns;
    std::unique_ptr<PetscScalar[]> values;
  };
  Part own, others;

  SplitRows(const CsrView& csr, PetscInt first_column) {
    MENISCUS_ASSERT(csr.row_start.size() > at(csr.num_rows), "{} rows, {} starts", csr.num_rows,
                    csr.row_start.size());
    find_starts(csr, first_column);
    for (Part* part : {&own, &others}) {
      const auto num_entries = static_cast<std::size_t>(part->start.back());
      part->columns = std::make_unique_for_overwrite<PetscInt[]>(num_entries);
      part->values = std::make_unique_for_overwrite<PetscScalar[]>(num_entries);
    }
    for (std::int32_t i = 0; i < csr.num_rows; ++i) {
      const auto [begin, middle, end] = row(csr, i);
      take_columns(csr, begin, middle, first_column, own, i);
      take_columns(csr, middle, end, 0, others, i);
    }
    take_values(csr);
  }

  /// Copies the values of a matrix with the same sparsity.
  void take_values(const CsrView& csr) {
    MENISCUS_ASSERT(std::size_t(csr.num_rows) + 1 == own.start.size(), "{} rows of {}",
                    csr.num_rows, own.start.size() - 1);
    for (std::int32_t i = 0; i < csr.num_rows; ++i) {
      const auto [begin, middle, end] = row(csr, i);
      MENISCUS_ASSERT(end - middle == others.start[at(i) + 1] - others.start[at(i)],
                      "row {} is of another sparsity", i);
      const double* values = csr.values.data();
      std::copy(values + begin, values + middle, own.values.get() + own.start[at(i)]);
      std::copy(values + middle, values + end, others.values.get() + others.start[at(i)]);
    }
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

  /// The start of a row, the start of its ghost columns, and its end.
  [[nodiscard]] std::array<std::int32_t, 3> row(const CsrView& csr, std::int32_t i) const {
    const std::int32_t begin = csr.row_start[at(i)];
    return {begin, begin + own.start[at(i) + 1] - own.start[at(i)], csr.row_start[at(i) + 1]};
  }

  /// Finds the starts of ghost columns. Owned columns come first in each row, and most rows have no
  /// others.
  void find_starts(const CsrView& csr, PetscInt first_column) {
    own.start.reserve(at(csr.num_rows) + 1);
    others.start.reserve(at(csr.num_rows) + 1);
    const auto is_own = [&](std::int32_t k) {
      const PetscInt column = csr.columns[at(k)] - first_column;
      return column >= 0 && column < csr.num_columns;
    };
    for (std::int32_t i = 0; i < csr.num_rows; ++i) {
      const std::int32_t begin = csr.row_start[at(i)], end = csr.row_start[at(i) + 1];
      std::int32_t middle = end;
      while (middle > begin && !is_own(middle - 1)) --middle;
      own.start.push_back(own.start.back() + middle - begin);
      others.start.push_back(others.start.back() + end - middle);
    }
  }

  static void take_columns(const CsrView& csr, std::int32_t begin, std::int32_t end,
                           PetscInt first_column, Part& part, std::int32_t row) {
    const std::int32_t to = part.start[at(row)] - begin;
    for (std::int32_t k = begin; k < end; ++k)
      part.columns[at(to + k)] = csr.columns[at(k)] - first_column;
  }
};

PetscErrorCode destroy_rows(void* rows) {
  const std::unique_ptr<SplitRows> owner(static_cast<SplitRows*>(rows));
  return 0;
}

constexpr const char* kRows = "meniscus_rows";

/// Ties the arrays of a matrix to its lifetime.
void attach_rows(Mat matrix, std::unique_ptr<SplitRows> rows) {
  Container container;
  petsc_check(PetscContainerCreate(PETSC_COMM_SELF, container.out()), "PetscContainerCreate");
  petsc_check(PetscContainerSetUserDestroy(container.get(), destroy_rows),
              "PetscContainerSetUserDestroy");
  petsc_check(PetscContainerSetPointer(container.get(), rows.release()),
              "PetscContainerSetPointer");
  petsc_check(PetscObjectCompose(reinterpret_cast<PetscObject>(matrix), kRows,
                                 reinterpret_cast<PetscObject>(container.get())),
              "PetscObjectCompose");
}

/// Copies values into a distributed matrix. PETSc does not notice, so data it derived from old
/// values is stale.
void take_values(Mat matrix, const CsrView& csr) {
  PetscObject container = nullptr;
  void* rows = nullptr;
  petsc_check(PetscObjectQuery(reinterpret_cast<PetscObject>(matrix), kRows, &container),
              "PetscObjectQuery");
  petsc_check(PetscContainerGetPointer(reinterpret_cast<PetscContainer>(container), &rows),
              "PetscContainerGetPointer");
  MENISCUS_ASSERT(rows != nullptr, "a matrix that was not made of rows");
  static_cast<SplitRows*>(rows)->take_values(csr);
}

Matrix shared_matrix(MPI_Comm comm, const CsrView& csr) {
  PetscInt first_column = 0;
  MPI_Exscan(&csr.num_columns, &first_column, 1, MPIU_INT, MPI_SUM, comm);
  auto rows = std::make_unique<SplitRows>(csr, first_column);
  Matrix matrix;
  petsc_check(MatCreateMPIAIJWithSplitArrays(comm, csr.num_rows, csr.num_columns, PETSC_DETERMINE,
                                             PETSC_DETERMINE, rows->own.start.data(),
                                             rows->own.columns.get(), rows->own.values.get(),
                                             rows->others.start.data(), rows->others.columns.get(),
                                             rows->others.values.get(), matrix.out()),
              "MatCreateMPIAIJWithSplitArrays");
  attach_rows(matrix.get(), std::move(rows));
  return matrix;
}

PetscErrorCode apply_operator(Mat matrix, Vec x, Vec y) {
  void* context = nullptr;
  PetscInt size = 0;
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscErrorCode code = MatShellGetContext(matrix, &context);
  if (code == 0) code = VecGetLocalSize(x, &size);
  if (code == 0) code = VecGetArrayRead(x, &in);
  if (code == 0) code = VecGetArray(y, &out);
  if (code != 0) return code;
  const auto count = static_cast<std::size_t>(size);
  try {  // no exception may pass through PETSc's frames
    (*static_cast<const LinearOperator*>(context))({in, count}, {out, count});
  } catch (const std::exception&) {
    code = PETSC_ERR_LIB;
  }
  const PetscErrorCode given_x = VecRestoreArrayRead(x, &in), given_y = VecRestoreArray(y, &out);
  return code != 0 ? code : (given_x != 0 ? given_x : given_y);
}

Matrix nest_of(MPI_Comm comm, std::array<Mat, 4> blocks) {
  Matrix nest;
  petsc_check(MatCreateNest(comm, 2, nullptr, 2, nullptr, blocks.data(), nest.out()),
              "MatCreateNest");
  return nest;
}

Matrix scaled_copy(MPI_Comm comm, const CsrView& csr, double scale) {
  Matrix copy = copied_matrix(comm, csr);
  petsc_check(MatScale(copy.get(), scale), "MatScale");
  return copy;
}

/// Adds `pin` to the diagonal entry of the first pressure, which rank 0 owns.
void add_pin(Mat matrix, std::int32_t num_velocities, double pin) {
  PetscInt first = 0;
  petsc_check(MatGetOwnershipRange(matrix, &first, nullptr), "MatGetOwnershipRange");
  if (first == 0)
    petsc_check(MatSetValue(matrix, num_velocities, num_velocities, pin, ADD_VALUES),
                "MatSetValue");
  petsc_check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc_check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
}

}  // namespace

Matrix borrowed_matrix(MPI_Comm comm, const CsrView& csr) {
  if (is_shared(comm)) return shared_matrix(comm, csr);
  MENISCUS_ASSERT(
      csr.row_start.size() > std::size_t(csr.num_rows) && csr.columns.size() == csr.values.size(),
      "{} rows, {} starts, {} columns, {} values", csr.num_rows, csr.row_start.size(),
      csr.columns.size(), csr.values.size());
  Matrix matrix;
  // PETSc's interface is not const-correct, but it neither writes nor frees these arrays.
  petsc_check(MatCreateSeqAIJWithArrays(comm, csr.num_rows, csr.num_columns,
                                        const_cast<PetscInt*>(csr.row_start.data()),
                                        const_cast<PetscInt*>(csr.columns.data()),
                                        const_cast<PetscScalar*>(csr.values.data()), matrix.out()),
              "MatCreateSeqAIJWithArrays");
  return matrix;
}

Matrix copied_matrix(MPI_Comm comm, const CsrView& csr) {
  Matrix borrowed = borrowed_matrix(comm, csr);
  if (is_shared(comm)) return borrowed;
  Matrix copy;
  petsc_check(MatDuplicate(borrowed.get(), MAT_COPY_VALUES, copy.out()), "MatDuplicate");
  return copy;
}

Vector zero_vector(MPI_Comm comm, PetscInt size) {
  Vector vector;
  if (is_shared(comm))
    petsc_check(VecCreateMPI(comm, size, PETSC_DETERMINE, vector.out()), "VecCreateMPI");
  else
    petsc_check(VecCreateSeq(comm, size, vector.out()), "VecCreateSeq");
  petsc_check(VecSet(vector.get(), 0.0), "VecSet");
  return vector;
}

Vector borrowed_vector(MPI_Comm comm, std::span<const double> values) {
  Vector vector;
  const auto size = static_cast<PetscInt>(values.size());
  if (is_shared(comm))
    petsc_check(VecCreateMPIWithArray(comm, 1, size, PETSC_DETERMINE, values.data(), vector.out()),
                "VecCreateMPIWithArray");
  else
    petsc_check(VecCreateSeqWithArray(comm, 1, size, values.data(), vector.out()),
                "VecCreateSeqWithArray");
  return vector;
}

Matrix shell_matrix(MPI_Comm comm, const LinearOperator& action, PetscInt size) {
  Matrix result;
  // PETSc only stores the context and returns it, so the const_cast is safe.
  petsc_check(MatCreateShell(comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE,
                             const_cast<LinearOperator*>(&action), result.out()),
              "MatCreateShell");
  petsc_check(
      MatShellSetOperation(result.get(), MATOP_MULT, reinterpret_cast<void (*)()>(apply_operator)),
      "MatShellSetOperation");
  return result;
}

NestedOperator nested_operator(MPI_Comm comm, const SaddleSystem& system) {
  NestedOperator result;
  result.A = borrowed_matrix(comm, system.A);
  result.B = borrowed_matrix(comm, system.B);
  result.minus_C = scaled_copy(comm, system.C, -1.0);
  if (!system.lower_left.empty())
    result.lower_left = borrowed_matrix(comm, system.lower_left_block());
  Matrix gradient;
  petsc_check(MatCreateTranspose(result.B.get(), gradient.out()), "MatCreateTranspose");
  Mat lower_left = result.lower_left ? result.lower_left.get() : result.B.get();
  result.nest = nest_of(comm, {result.A.get(), gradient.get(), lower_left, result.minus_C.get()});
  return result;
}

bool take_values(MPI_Comm comm, const SaddleSystem& system, NestedOperator& nested) {
  if (!is_shared(comm) || !nested.nest || bool(nested.lower_left) == system.lower_left.empty())
    return false;
  PetscInt num_rows = 0;
  petsc_check(MatGetLocalSize(nested.A.get(), &num_rows, nullptr), "MatGetLocalSize");
  if (num_rows != system.num_velocities()) return false;
  take_values(nested.A.get(), system.A);
  take_values(nested.B.get(), system.B);
  take_values(nested.minus_C.get(), system.C);
  petsc_check(MatScale(nested.minus_C.get(), -1.0), "MatScale");
  if (nested.lower_left) take_values(nested.lower_left.get(), system.lower_left_block());
  return true;
}

MergedMatrix merged_matrix(MPI_Comm comm, const SaddleSystem& system, double continuity_sign,
                           double pin) {
  MergedMatrix result;
  if (!is_shared(comm)) {
    result.arrays = merged_system(system, continuity_sign, pin);
    result.handle = borrowed_matrix(comm, result.arrays.view());
    return result;
  }
  const Matrix A = borrowed_matrix(comm, system.A), B = borrowed_matrix(comm, system.B),
               lower_left = scaled_copy(comm, system.lower_left_block(), continuity_sign),
               corner = scaled_copy(comm, system.C, -continuity_sign);
  Matrix gradient;
  petsc_check(MatTranspose(B.get(), MAT_INITIAL_MATRIX, gradient.out()), "MatTranspose");
  const Matrix nest = nest_of(comm, {A.get(), gradient.get(), lower_left.get(), corner.get()});
  petsc_check(MatConvert(nest.get(), MATAIJ, MAT_INITIAL_MATRIX, result.handle.out()),
              "MatConvert");
  if (pin != 0.0) add_pin(result.handle.get(), system.num_velocities(), -continuity_sign * pin);
  return result;
}

void attach_constant_pressure(Communicator communicator, Mat matrix, std::int32_t num_velocities,
                              std::int32_t num_pressures, std::span<const double> row_weights) {
  MPI_Comm comm = mpi_communicator(communicator);
  // The pressures in the direction given, of length one.
  const auto space_of = [&](const auto& entry) {
    const Vector pressures = zero_vector(comm, num_velocities + num_pressures);
    PetscScalar* values = nullptr;
    petsc_check(VecGetArray(pressures.get(), &values), "VecGetArray");
    for (std::int32_t i = num_velocities; i < num_velocities + num_pressures; ++i)
      values[i] = entry(static_cast<std::size_t>(i));
    petsc_check(VecRestoreArray(pressures.get(), &values), "VecRestoreArray");
    petsc_check(VecNormalize(pressures.get(), nullptr), "VecNormalize");
    std::array<Vec, 1> vectors = {pressures.get()};
    NullSpace space;
    petsc_check(MatNullSpaceCreate(comm, PETSC_FALSE, 1, vectors.data(), space.out()),
                "MatNullSpaceCreate");
    return space;
  };
  const NullSpace right = space_of([](std::size_t) { return 1.0; });
  const NullSpace left =
      space_of([&](std::size_t i) { return row_weights.empty() ? 1.0 : 1.0 / row_weights[i]; });
  petsc_check(MatSetNullSpace(matrix, right.get()), "MatSetNullSpace");
  petsc_check(MatSetTransposeNullSpace(matrix, left.get()), "MatSetTransposeNullSpace");
}

}  // namespace meniscus::linear
