#pragma once
// Only for the .cpp files of this room: nothing else includes PETSc.

#include <stdexcept>
#include <utility>

#include <petscksp.h>

#include "meniscus/linear/communicator.hpp"

namespace meniscus::linear {

/// A PETSc call that returned an error code; the text is PETSc's own, with the function's name.
class PetscFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws PetscFailure unless `code` is zero.
void petsc_check(PetscErrorCode code, const char* function);
/// Starts PETSc (and MPI) unless it runs: no arguments, no resource files, no signal handlers, and
/// an error handler that returns codes in silence.
void start_petsc();
/// PETSc's own for one process where there is but one.
[[nodiscard]] MPI_Comm mpi_communicator(Communicator communicator);

/// Sole owner of a PETSc object. `out()` is for the functions that create one.
template <class Handle, PetscErrorCode (*Destroy)(Handle*)>
class Owned {
 public:
  Owned() = default;
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, nullptr);
    }
    return *this;
  }
  ~Owned() { reset(); }

  [[nodiscard]] Handle get() const { return handle_; }
  [[nodiscard]] explicit operator bool() const { return handle_ != nullptr; }
  [[nodiscard]] Handle* out() {
    reset();
    return &handle_;
  }
  void reset() noexcept {
    PetscBool is_over = PETSC_FALSE;  // objects of static duration may outlive PETSc
    if (handle_ != nullptr && PetscFinalized(&is_over) == 0 && !is_over) Destroy(&handle_);
    handle_ = nullptr;
  }

 private:
  Handle handle_ = nullptr;
};

using Matrix = Owned<Mat, MatDestroy>;
using Vector = Owned<Vec, VecDestroy>;
using KrylovSolver = Owned<KSP, KSPDestroy>;
using NullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;
using OptionTable = Owned<PetscOptions, PetscOptionsDestroy>;

/// Makes `table` the one that PETSc objects ask for their options, while it lives.
class OptionScope {
 public:
  explicit OptionScope(PetscOptions table) {
    petsc_check(PetscOptionsPush(table), "PetscOptionsPush");
  }
  OptionScope(const OptionScope&) = delete;
  OptionScope& operator=(const OptionScope&) = delete;
  ~OptionScope() { PetscOptionsPop(); }
};

}  // namespace meniscus::linear
