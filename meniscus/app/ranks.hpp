#pragma once

#include <functional>

namespace meniscus {

// A run under mpirun: every rank goes through all of it, in step, and rank 0 alone writes and
// speaks. On one rank these do nothing but call what they are given.

[[nodiscard]] int num_ranks();
[[nodiscard]] bool is_first_rank();
/// Whether one rank or more says so: a signal may reach any. Collective.
[[nodiscard]] bool any_rank(bool own);
/// Rank 0 acts, after all have come here; what it throws is thrown on all. Collective.
void on_first_rank(const std::function<void()>& action);

/// For a rank that has caught an exception: returns if all have, as they do whenever what failed
/// was computed by all or made known by `on_first_rank`. Else the others wait for it in vain: says
/// why and ends all ranks.
void require_all_failed(const std::exception& failure);
/// Runs a command, warnings being rank 0's to give, and ends all ranks with one status and one
/// message whichever of them throws. Returns the exit status, on rank 0 throws what the command
/// did.
[[nodiscard]] int on_all_ranks(const std::function<int()>& command);

}  // namespace meniscus
