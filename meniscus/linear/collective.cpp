#include "meniscus/linear/collective.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <thread>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/petsc_objects.hpp"

namespace meniscus::linear {
namespace {

// PETSc sends on duplicates of this communicator, so no message of PETSc can have this tag.
constexpr int kArrivalTag = 4711;

/// FNV-1a hash of the numbers' bits in four interleaved strands: a single strand would wait for
/// each product.
template <typename Number, typename Bits>
std::uint64_t fingerprint(std::span<const Number> numbers) {
  constexpr std::uint64_t basis = 14695981039346656037u, prime = 1099511628211u;
  std::array<std::uint64_t, 4> strand = {basis, basis, basis, basis};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    strand[i % 4] = (strand[i % 4] ^ std::uint64_t{std::bit_cast<Bits>(numbers[i])}) * prime;
  std::uint64_t hash = (basis ^ numbers.size()) * prime;
  for (const std::uint64_t value : strand) hash = (hash ^ value) * prime;
  return hash;
}

MPI_Comm handle_of(Communicator communicator) { return mpi_communicator(communicator); }

}  // namespace

double sum(Communicator communicator, double local) {
  if (communicator.size() == 1) return local;
  double all = 0.0;
  MPI_Allreduce(&local, &all, 1, MPI_DOUBLE, MPI_SUM, handle_of(communicator));
  return all;
}

void sum(Communicator communicator, std::span<double> numbers) {
  if (communicator.size() == 1) return;
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_SUM,
                handle_of(communicator));
}

std::int64_t sum(Communicator communicator, std::int64_t local) {
  if (communicator.size() == 1) return local;
  std::int64_t all = 0;
  MPI_Allreduce(&local, &all, 1, MPI_INT64_T, MPI_SUM, handle_of(communicator));
  return all;
}

double norm(Communicator communicator, double local) {
  return communicator.size() == 1 ? local : std::sqrt(sum(communicator, local * local));
}

bool any(Communicator communicator, bool local) {
  return sum(communicator, std::int64_t{local}) > 0;
}

bool agree(Communicator communicator, std::uint64_t local) {
  if (communicator.size() == 1) return true;
  // The largest number and the largest complement are complements of each other only where all
  // ranks agree.
  const std::array<std::uint64_t, 2> mine = {local, ~local};
  std::array<std::uint64_t, 2> largest{};
  MPI_Allreduce(mine.data(), largest.data(), 2, MPI_UINT64_T, MPI_MAX, handle_of(communicator));
  return largest[0] == ~largest[1];
}

bool agree(Communicator communicator, std::span<const std::int32_t> local) {
  return communicator.size() == 1 ||
         agree(communicator, fingerprint<std::int32_t, std::uint32_t>(local));
}

bool agree(Communicator communicator, std::span<const double> local) {
  return communicator.size() == 1 || agree(communicator, fingerprint<double, std::uint64_t>(local));
}

void barrier(Communicator communicator) {
  if (communicator.size() > 1) MPI_Barrier(handle_of(communicator));
}

void broadcast(Communicator communicator, std::string& text, int root) {
  if (communicator.size() == 1) return;
  auto length = static_cast<std::int64_t>(text.size());
  MPI_Bcast(&length, 1, MPI_INT64_T, root, handle_of(communicator));
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root, handle_of(communicator));
}

void broadcast(Communicator communicator, std::span<std::int32_t> numbers) {
  if (communicator.size() == 1) return;
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_INT32_T, 0,
            handle_of(communicator));
}

void gather(Communicator communicator, std::span<const double> local,
            std::span<const std::int32_t> counts, std::span<double> all) {
  if (communicator.size() == 1) {
    std::ranges::copy(local, all.begin());
    return;
  }
  std::vector<int> starts;
  int next = 0;
  for (const std::int32_t count : counts) {
    starts.push_back(next);
    next += count;
  }
  MENISCUS_ASSERT(
      counts.size() == std::size_t(communicator.size()) && std::size_t(next) == all.size(),
      "{} counts, {} of {} values", counts.size(), next, all.size());
  MENISCUS_ASSERT(local.size() == std::size_t(counts[std::size_t(communicator.rank())]), "{}",
                  local.size());
  MPI_Allgatherv(local.data(), static_cast<int>(local.size()), MPI_DOUBLE, all.data(),
                 counts.data(), starts.data(), MPI_DOUBLE, handle_of(communicator));
}

bool all_arrive(Communicator communicator, std::chrono::milliseconds patience) {
  const int size = communicator.size(), rank = communicator.rank();
  if (size == 1) return true;
  std::vector<MPI_Request> requests;
  for (int other = 0; other < size; ++other) {
    if (other == rank) continue;
    MPI_Isend(nullptr, 0, MPI_CHAR, other, kArrivalTag, handle_of(communicator),
              &requests.emplace_back());
    MPI_Irecv(nullptr, 0, MPI_CHAR, other, kArrivalTag, handle_of(communicator),
              &requests.emplace_back());
  }
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (int is_done = 0; std::chrono::steady_clock::now() < deadline;) {
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &is_done, MPI_STATUSES_IGNORE);
    if (is_done != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;  // messages stay pending: the program is about to end
}

void abort(Communicator communicator, int status) {
  MPI_Abort(handle_of(communicator), status);
  std::abort();  // MPI_Abort does not return
}

}  // namespace meniscus::linear
