#include "meniscus/flow/bem/shared_points.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

#include "meniscus/linear/collective.hpp"

namespace meniscus::bem {
namespace {
constexpr std::int32_t kBlock = 64;  // targets: a few µs of work each, so that no thread idles long
}

SharedPoints::SharedPoints(std::int32_t count, linear::Communicator communicator, int threads)
    : communicator_(communicator), threads_(threads) {
  const std::int32_t size = communicator.size();
  for (std::int32_t rank = 0; rank < size; ++rank)
    counts_.push_back(count / size + (rank < count % size ? 1 : 0));
  first_ = std::accumulate(counts_.begin(), counts_.begin() + communicator.rank(), 0);
}

void SharedPoints::for_own(const std::function<void(std::int32_t, std::int32_t)>& work) const {
  const std::int32_t end = first_ + counts_[static_cast<std::size_t>(communicator_.rank())];
  std::atomic<std::int32_t> next = first_;
  const auto take_blocks = [&] {
    for (;;) {
      const std::int32_t begin = next.fetch_add(kBlock);
      if (begin >= end) return;
      work(begin, std::min(begin + kBlock, end));
    }
  };
  std::vector<std::jthread> helpers;
  const std::int32_t blocks = (end - first_ + kBlock - 1) / kBlock;
  for (int i = 1; i < std::min<std::int32_t>(threads_, blocks); ++i)
    helpers.emplace_back(take_blocks);
  take_blocks();
}

void SharedPoints::gather(std::span<double> values) const {
  if (communicator_.size() == 1) return;
  const auto count =
      static_cast<std::size_t>(std::accumulate(counts_.begin(), counts_.end(), std::int32_t{0}));
  const auto num_own =
      static_cast<std::size_t>(counts_[static_cast<std::size_t>(communicator_.rank())]);
  for (std::size_t begin = 0; begin < values.size(); begin += count) {
    const std::span<double> all = values.subspan(begin, count);
    const auto mine = all.subspan(static_cast<std::size_t>(first_), num_own);
    const std::vector<double> own(mine.begin(), mine.end());
    linear::gather(communicator_, own, counts_, all);
  }
}

}  // namespace meniscus::bem
