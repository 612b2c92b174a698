#pragma once
// Private header of this room.

#include "meniscus/linear/petsc_objects.hpp"

namespace meniscus::linear {

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

}  // namespace meniscus::linear
