#pragma once
// Private header of this room: no other room includes PETSc.

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
/// Starts PETSc and MPI unless they run, without arguments, resource files or signal handlers, and
/// with an error handler that silently returns codes.
void start_petsc();
/// The MPI communicator; PETSC_COMM_SELF where there is one process.
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

/// Makes `table` PETSc's current options table during its lifetime.
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
