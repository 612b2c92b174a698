#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "meniscus/linear/communicator.hpp"

namespace meniscus::linear {

// What all ranks of a communicator do together: every rank must call, in the same order. On one
// rank each returns what it was given. Results are the same on every rank, bit for bit.

[[nodiscard]] double sum(Communicator communicator, double own);
[[nodiscard]] std::int64_t sum(Communicator communicator, std::int64_t own);
/// Euclidean norm of the ranks' norms.
[[nodiscard]] double norm(Communicator communicator, double own);
/// Whether one rank or more says so.
[[nodiscard]] bool any(Communicator communicator, bool own);
/// Whether all ranks give the same number.
[[nodiscard]] bool agree(Communicator communicator, std::uint64_t own);
/// Whether all ranks give as many numbers and the same, bit for bit, as far as 64 bits can tell.
[[nodiscard]] bool agree(Communicator communicator, std::span<const std::int32_t> own);
[[nodiscard]] bool agree(Communicator communicator, std::span<const double> own);
void barrier(Communicator communicator);
/// Everyone's becomes what rank 0 has; a text's length goes with it, a span's must be the same.
void broadcast(Communicator communicator, std::string& text);
void broadcast(Communicator communicator, std::span<std::int32_t> numbers);
/// Writes the ranks' parts one after the other to everyone's `all`; `counts` are their lengths.
void gather(Communicator communicator, std::span<const double> own,
            std::span<const std::int32_t> counts, std::span<double> all);

/// For a rank that has met an error, and may be alone with it while the others wait in a collective
/// call: whether all ranks call this within the time. If not, `abort` is what is left.
[[nodiscard]] bool all_arrive(Communicator communicator, std::chrono::milliseconds patience);
/// Ends all ranks, wherever they are; programs end with `status`.
[[noreturn]] void abort(Communicator communicator, int status);

}  // namespace meniscus::linear
