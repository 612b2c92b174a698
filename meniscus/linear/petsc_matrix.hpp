#pragma once
// Private header of this room.

#include <span>

#include "meniscus/linear/petsc_objects.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

// All functions are collective: every rank of the communicator passes its own part.

/// A PETSc matrix of this rank's rows. It borrows the caller's arrays on one rank, else copies
/// them.
[[nodiscard]] Matrix borrowed_matrix(MPI_Comm comm, const CsrView& csr);
/// A PETSc matrix of this rank's rows with its own arrays.
[[nodiscard]] Matrix copied_matrix(MPI_Comm comm, const CsrView& csr);
/// A PETSc vector of zeros with `size` entries on this rank.
[[nodiscard]] Vector zero_vector(MPI_Comm comm, PetscInt size);
/// A PETSc vector that borrows the caller's array. PETSc writes to it only if the vector is
/// written.
[[nodiscard]] Vector borrowed_vector(MPI_Comm comm, std::span<const double> values);
/// A square PETSc matrix with so many rows on this rank that is given by its action, to which it
/// refers.
[[nodiscard]] Matrix shell_matrix(MPI_Comm comm, const LinearOperator& action, PetscInt size);
/// The operator [A Bᵀ; B −C] as a nest of matrices. Each rank has its velocities, then its
/// pressures.
struct NestedOperator {
  Matrix A, B, minus_C;
  Matrix lower_left;  ///< empty where it is B
  Matrix nest;        ///< refers to the matrices above
};
[[nodiscard]] NestedOperator nested_operator(MPI_Comm comm, const SaddleSystem& system);
/// Copies the values of a system into an operator of another system with the same sparsity. Returns
/// false and does nothing where a new operator is needed. That is on one rank, where matrices
/// borrow the caller's arrays, and where only one of the two has a separate lower left block.
[[nodiscard]] bool take_values(MPI_Comm comm, const SaddleSystem& system, NestedOperator& nested);
/// The system as one matrix [A Bᵀ; sB −sC] in the numbering of the nest. `pin` as in
/// `merged_system`.
struct MergedMatrix {
  CsrMatrix arrays;  ///< the arrays that the handle borrows
  Matrix handle;
};
[[nodiscard]] MergedMatrix merged_matrix(MPI_Comm comm, const SaddleSystem& system,
                                         double continuity_sign, double pin);
/// Attaches the constant pressure as null space to a matrix of the whole system.
void attach_constant_pressure(Communicator communicator, Mat matrix, std::int32_t num_velocities,
                              std::int32_t num_pressures, std::span<const double> row_weights = {});

}  // namespace meniscus::linear
