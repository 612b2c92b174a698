#pragma once

#include <functional>
#include <span>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/share_numbers.hpp"
#include "meniscus/linear/communicator.hpp"

namespace meniscus::linear {

/// The rank that does each piece of work: the largest piece first, each by the rank that has least
/// to do so far.
[[nodiscard]] std::vector<int> ranks_for(std::span<const double> work, int num_ranks);

/// Makes piece k and saves it for the ranks that do not make it.
using MakePiece = std::function<void(std::size_t k, Archive& archive)>;
/// Takes piece k as another rank saved it.
using TakePiece = std::function<void(std::size_t k, const Archive& archive)>;

/// Shares independent pieces of work of about the given sizes, the same on all ranks. Each is made
/// by one rank and taken by the others. What `make` throws on one rank is thrown on all, as
/// InvalidInput or RunFailure, with the text of the first rank that threw. Collective.
void share_work(Communicator communicator, std::span<const double> work, const MakePiece& make,
                const TakePiece& take);

/// The `width` numbers of each of `count` items of about equal cost, one item after the other, on
/// every rank. Each rank finds those of a stretch of the items. `find` must not throw. Collective.
[[nodiscard]] std::vector<double> shared_numbers(Communicator communicator, std::size_t count,
                                                 std::size_t width, const FindNumbers& find);

}  // namespace meniscus::linear
