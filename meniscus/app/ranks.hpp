#pragma once

#include <functional>
#include <string>

namespace meniscus {

// Helpers for runs under mpirun. Every rank executes the whole run in step. Rank 0 prints and
// writes files, but for frames of the volume, which the last rank writes at the same time. On one
// rank these functions just call their arguments.

[[nodiscard]] int num_ranks();
[[nodiscard]] bool is_first_rank();
/// Whether `local` is true on one rank or more, as a signal may reach any rank. Collective.
[[nodiscard]] bool any_rank(bool local);
/// Calls `action` on rank 0 after all ranks have arrived. Its exception is thrown on all ranks.
/// Collective.
void on_first_rank(const std::function<void()>& action);
/// Calls `first` on rank 0 and `last` on the last rank at the same time; on one rank one after the
/// other. An exception of either is thrown on all ranks. Collective.
void on_first_and_last_rank(const std::function<void()>& first, const std::function<void()>& last);
/// The text that rank 0 has, on all ranks. Collective.
[[nodiscard]] std::string text_of_first_rank(std::string text);

/// Called by a rank that has caught an exception. Returns if all ranks call it: all computed what
/// failed, or `on_first_rank` threw on all. Otherwise the others would wait for ever: prints the
/// reason and ends all ranks.
void require_all_failed(const std::exception& failure);
/// Runs a command on all ranks with warnings from rank 0 only. Whichever rank throws, all end with
/// one status and one message. Returns the exit status; on rank 0 rethrows the command's exception.
[[nodiscard]] int on_all_ranks(const std::function<int()>& command);

}  // namespace meniscus
