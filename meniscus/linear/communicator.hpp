#pragma once

namespace meniscus::linear {

/// A group of processes. It holds MPI's portable integer handle, so that MPI itself stays inside
/// this room. Making one starts PETSc and MPI if nobody has; they are stopped at exit by whoever
/// started them.
class Communicator {
 public:
  static Communicator self();
  static Communicator world();

  [[nodiscard]] int rank() const;
  [[nodiscard]] int size() const;
  [[nodiscard]] int handle() const { return handle_; }

 private:
  explicit Communicator(int handle) : handle_(handle) {}
  int handle_;
};

}  // namespace meniscus::linear
