#pragma once

namespace meniscus::linear {

/// Which processes share the work.
enum class Processes {
  alone,  ///< each process works alone
  all     ///< the processes that mpirun started share the work and must make the same calls
};

/// A group of processes. It holds MPI's portable integer handle, so that MPI stays inside this
/// room. The constructor starts PETSc and MPI unless they run; if it started them, they are stopped
/// at exit.
class Communicator {
 public:
  static Communicator self();
  static Communicator world();
  static Communicator of(Processes processes) {
    return processes == Processes::all ? world() : self();
  }

  [[nodiscard]] int rank() const;
  [[nodiscard]] int size() const;
  [[nodiscard]] int handle() const { return handle_; }

 private:
  explicit Communicator(int handle) : handle_(handle) {}
  int handle_;
};

}  // namespace meniscus::linear
