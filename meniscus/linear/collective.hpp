#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "meniscus/linear/communicator.hpp"

namespace meniscus::linear {

// Collective operations: every rank of a communicator must call them, in the same order. On one
// rank each returns or keeps its argument. Results are the same on every rank, bit for bit.

[[nodiscard]] double sum(Communicator communicator, double local);
/// Sums number by number, in place.
void sum(Communicator communicator, std::span<double> numbers);
[[nodiscard]] std::int64_t sum(Communicator communicator, std::int64_t local);
/// Euclidean norm of the whole vector from the norm of each rank's part.
[[nodiscard]] double norm(Communicator communicator, double local);
/// Whether `local` is true on one rank or more.
[[nodiscard]] bool any(Communicator communicator, bool local);
/// Whether all ranks give the same number.
[[nodiscard]] bool agree(Communicator communicator, std::uint64_t local);
/// Whether all ranks give equal lists of numbers, bit for bit, as far as a hash of 64 bits tells.
[[nodiscard]] bool agree(Communicator communicator, std::span<const std::int32_t> local);
[[nodiscard]] bool agree(Communicator communicator, std::span<const double> local);
void barrier(Communicator communicator);
/// Sends the value of rank 0, or of rank `root`, to all ranks. A text is resized; a span must have
/// the length of rank 0.
void broadcast(Communicator communicator, std::string& text, int root = 0);
void broadcast(Communicator communicator, std::span<std::int32_t> numbers);
/// Gathers the ranks' parts in `all`, in the order of ranks, on every rank. `counts` are the
/// lengths of the parts.
void gather(Communicator communicator, std::span<const double> local,
            std::span<const std::int32_t> counts, std::span<double> all);

/// Whether all ranks call this function within the time. A rank that met an error calls it: ranks
/// without error wait in another collective call, and only `abort` can end them.
[[nodiscard]] bool all_arrive(Communicator communicator, std::chrono::milliseconds patience);
/// Ends all ranks, wherever they are. Their programs end with `status`.
[[noreturn]] void abort(Communicator communicator, int status);

}  // namespace meniscus::linear
