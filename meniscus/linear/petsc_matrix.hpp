#pragma once
// Only for the .cpp files of this room.

#include <span>

#include "meniscus/linear/petsc_objects.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

/// A PETSc matrix on the caller's arrays: nothing is copied.
[[nodiscard]] Matrix borrowed_matrix(const CsrView& csr);
/// A PETSc vector of `size` zeros.
[[nodiscard]] Vector zero_vector(PetscInt size);
/// A PETSc vector on the caller's array, which it never writes to when only read.
[[nodiscard]] Vector borrowed_vector(std::span<const double> values);
/// The operator [A Bᵀ; B −C] as a nest of borrowed matrices. The nest refers to its blocks.
[[nodiscard]] Matrix nested_operator(const SaddleSystem& system);
/// Tells a matrix of the whole system that the constant pressure is its null vector.
void attach_constant_pressure(Mat matrix, std::int32_t num_velocities, std::int32_t num_pressures);

}  // namespace meniscus::linear
