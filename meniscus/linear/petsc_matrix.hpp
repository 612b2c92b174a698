#pragma once
// Only for the .cpp files of this room.

#include <span>

#include "meniscus/linear/petsc_objects.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

// All are collective on the communicator, whose ranks give their own parts.

/// A PETSc matrix of this rank's rows: on the caller's arrays where there is one rank, else a copy.
[[nodiscard]] Matrix borrowed_matrix(MPI_Comm comm, const CsrView& csr);
/// A PETSc matrix of this rank's rows on arrays of its own.
[[nodiscard]] Matrix copied_matrix(MPI_Comm comm, const CsrView& csr);
/// A PETSc vector of `size` zeros here.
[[nodiscard]] Vector zero_vector(MPI_Comm comm, PetscInt size);
/// A PETSc vector on the caller's array, which it never writes to when only read.
[[nodiscard]] Vector borrowed_vector(MPI_Comm comm, std::span<const double> values);
/// The operator [A Bᵀ; B −C] as a nest of borrowed matrices. A rank has its velocities, then its
/// pressures, side by side.
struct NestedOperator {
  Matrix A, B, minus_C;
  Matrix lower_left;  ///< none where it is B
  Matrix nest;        ///< refers to the others
};
[[nodiscard]] NestedOperator nested_operator(MPI_Comm comm, const SaddleSystem& system);
/// Gives an operator that was made for another system on the same sparsity the values of this one.
/// False, and nothing done, where a new one is due: on one rank, whose matrices are the caller's
/// arrays; and where one of the two has a lower left block of its own and the other has not.
[[nodiscard]] bool take_values(MPI_Comm comm, const SaddleSystem& system, NestedOperator& nested);
/// The system as one matrix [A Bᵀ; sB −sC], with `pin` as `merged` takes it, numbered as the nest
/// is.
struct MergedMatrix {
  CsrMatrix arrays;  ///< those that the handle borrows
  Matrix handle;
};
[[nodiscard]] MergedMatrix merged_matrix(MPI_Comm comm, const SaddleSystem& system,
                                         double continuity_sign, double pin);
/// Tells a matrix of the whole system that the constant pressure is its null vector.
void attach_constant_pressure(Communicator communicator, Mat matrix, std::int32_t num_velocities,
                              std::int32_t num_pressures);

}  // namespace meniscus::linear
