#pragma once

namespace meniscus::linear {

/// Which processes share the work.
enum class Processes {
  alone,  ///< none: each that calls does all
  all     ///< those that mpirun started, which must all make the same calls
};

/// A group of processes. It holds MPI's portable integer handle, so that MPI itself stays inside
/// this room. Making one starts PETSc and MPI if nobody has; they are stopped at exit by whoever
/// started them.
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
