#include "meniscus/linear/petsc_objects.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"

// Sets one BLAS thread per rank, as more compete for the cores. Weak: present when BLAS is
// OpenBLAS.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace meniscus::linear {
namespace {

void stop_petsc() {
  PetscBool is_over = PETSC_FALSE;
  if (PetscFinalized(&is_over) == 0 && !is_over) PetscFinalize();
}

}  // namespace

void petsc_check(PetscErrorCode code, const char* function) {
  if (code == 0) return;
  const char* text = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &text, &specific);
  throw PetscFailure(fmt::format("{}: {} ({})", function, text != nullptr ? text : "unknown error",
                                 specific != nullptr ? specific : ""));
}

namespace {

/// Whether mpirun, or another launcher, started this process as one of its ranks.
bool is_launched() {
  return std::ranges::any_of(std::array{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"},
                             [](const char* name) { return std::getenv(name) != nullptr; });
}

/// Whether mpirun says that all ranks share this machine.
bool is_on_one_machine() {
  const char *all = std::getenv("OMPI_COMM_WORLD_SIZE"),
             *here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  return all != nullptr && here != nullptr && std::string_view(all) == here;
}

/// Settings of Open MPI while it starts. Where no other machine takes part no network is probed,
/// and a process without a launcher starts no daemon. This saves 0.3 s, and 5 s where the host's
/// name is not known. What the user has set stays; processes started from here inherit nothing.
class StartSettings {
 public:
  StartSettings() {
    if (!is_launched()) {
      set("OMPI_MCA_ess_singleton_isolated", "1");
      // All such processes would share one folder, and remove it under each other.
      set("OMPI_MCA_orte_create_session_dirs", "0");
    }
    if (!is_launched() || is_on_one_machine()) set("OMPI_MCA_pml", "ob1");
  }
  ~StartSettings() {
    for (const char* name : names_) unsetenv(name);
  }
  StartSettings(const StartSettings&) = delete;
  StartSettings& operator=(const StartSettings&) = delete;

 private:
  void set(const char* name, const char* value) {
    if (std::getenv(name) != nullptr) return;
    setenv(name, value, 0);
    names_.push_back(name);
  }

  std::vector<const char*> names_;
};

}  // namespace

void start_petsc() {
  PetscBool is_running = PETSC_FALSE;
  petsc_check(PetscInitialized(&is_running), "PetscInitialized");
  if (is_running) return;
  // Open MPI's default maps a file of megabytes, which fails under a small limit on file sizes.
  setenv("PMIX_MCA_gds", "hash", 0);
  // A copy through shared memory costs less than the system call that lets one process read
  // another's.
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  // Most messages of one multigrid level are then sent eagerly, without a handshake.
  setenv("OMPI_MCA_btl_vader_eager_limit", "65536", 0);
  // Where /sys is not mounted, hwloc says so; nothing depends on it.
  setenv("HWLOC_HIDE_ERRORS", "2", 0);
  // With threads Scotch's partitions are not reproducible.
  setenv("SCOTCH_PTHREAD_NUMBER", "1", 1);
  petsc_check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"), "PetscOptionsSetValue");
  petsc_check(PetscOptionsSetValue(nullptr, "-skip_petscrc", "true"), "PetscOptionsSetValue");
  {
    const StartSettings settings;
    petsc_check(PetscInitializeNoArguments(), "PetscInitializeNoArguments");
  }
  petsc_check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr), "PetscPushErrorHandler");
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  std::atexit(stop_petsc);
}

MPI_Comm mpi_communicator(Communicator communicator) {
  MPI_Comm comm = MPI_Comm_f2c(static_cast<MPI_Fint>(communicator.handle()));
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size == 1 ? PETSC_COMM_SELF : comm;
}

Communicator Communicator::self() {
  start_petsc();
  return Communicator(static_cast<int>(MPI_Comm_c2f(PETSC_COMM_SELF)));
}

Communicator Communicator::world() {
  start_petsc();
  return Communicator(static_cast<int>(MPI_Comm_c2f(PETSC_COMM_WORLD)));
}

int Communicator::rank() const {
  int rank = 0;
  MPI_Comm_rank(mpi_communicator(*this), &rank);
  return rank;
}

int Communicator::size() const {
  int size = 1;
  MPI_Comm_size(mpi_communicator(*this), &size);
  return size;
}

}  // namespace meniscus::linear
