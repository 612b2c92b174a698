#include "meniscus/linear/ghost_values.hpp"

#include <array>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/petsc_objects.hpp"

namespace meniscus::linear {
namespace {

using IndexSet = Owned<IS, ISDestroy>;
using Scatter = Owned<VecScatter, VecScatterDestroy>;

/// The array that a vector has during this object's lifetime. PETSc writes to the one that a
/// scatter goes to.
class PlacedArray {
 public:
  PlacedArray(Vec vector, const double* values) : vector_(vector) {
    petsc_check(VecPlaceArray(vector, values), "VecPlaceArray");
  }
  PlacedArray(const PlacedArray&) = delete;
  PlacedArray& operator=(const PlacedArray&) = delete;
  ~PlacedArray() { VecResetArray(vector_); }

 private:
  Vec vector_;
};

}  // namespace

class GhostValues::Implementation {
 public:
  Implementation(Communicator communicator, std::int32_t num_owned,
                 std::span<const std::int32_t> wanted, std::int32_t values_each)
      : num_owned_(std::size_t(num_owned) * std::size_t(values_each)),
        num_wanted_(wanted.size() * std::size_t(values_each)) {
    petsc_check(
        VecCreateMPIWithArray(mpi_communicator(communicator), values_each,
                              static_cast<PetscInt>(num_owned_), PETSC_DECIDE, nullptr, all_.out()),
        "VecCreateMPIWithArray");
    petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, values_each,
                                      static_cast<PetscInt>(num_wanted_), nullptr, ghosts_.out()),
                "VecCreateSeqWithArray");
    IndexSet numbers;
    petsc_check(ISCreateBlock(PETSC_COMM_SELF, values_each, static_cast<PetscInt>(wanted.size()),
                              wanted.data(), PETSC_COPY_VALUES, numbers.out()),
                "ISCreateBlock");
    petsc_check(VecScatterCreate(all_.get(), numbers.get(), ghosts_.get(), nullptr, scatter_.out()),
                "VecScatterCreate");
  }

  void fetch(std::span<const double> owned, std::span<double> wanted) const {
    const auto placed = place(owned, wanted);
    scatter(all_.get(), ghosts_.get(), INSERT_VALUES, SCATTER_FORWARD);
  }

  void give(std::span<const double> wanted, std::span<double> owned) const {
    const auto placed = place(owned, wanted);
    scatter(ghosts_.get(), all_.get(), ADD_VALUES, SCATTER_REVERSE);
  }

 private:
  [[nodiscard]] std::array<PlacedArray, 2> place(std::span<const double> owned,
                                                 std::span<const double> wanted) const {
    MENISCUS_ASSERT(owned.size() == num_owned_ && wanted.size() == num_wanted_, "{} and {} values",
                    owned.size(), wanted.size());
    return {PlacedArray(all_.get(), owned.data()), PlacedArray(ghosts_.get(), wanted.data())};
  }
  void scatter(Vec from, Vec to, InsertMode insert, ScatterMode direction) const {
    petsc_check(VecScatterBegin(scatter_.get(), from, to, insert, direction), "VecScatterBegin");
    petsc_check(VecScatterEnd(scatter_.get(), from, to, insert, direction), "VecScatterEnd");
  }

  std::size_t num_owned_, num_wanted_;
  Vector all_, ghosts_;
  Scatter scatter_;
};

GhostValues::GhostValues(Communicator communicator, std::int32_t num_owned,
                         std::span<const std::int32_t> wanted, std::int32_t values_each)
    : implementation_(
          std::make_unique<Implementation>(communicator, num_owned, wanted, values_each)) {}
GhostValues::~GhostValues() = default;

void GhostValues::fetch(std::span<const double> owned, std::span<double> wanted) const {
  implementation_->fetch(owned, wanted);
}

void GhostValues::give(std::span<const double> wanted, std::span<double> owned) const {
  implementation_->give(wanted, owned);
}

}  // namespace meniscus::linear
