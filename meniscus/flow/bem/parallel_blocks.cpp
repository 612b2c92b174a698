#include "meniscus/flow/bem/parallel_blocks.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace meniscus::bem {
namespace {
constexpr std::int32_t kBlock = 64;  // targets: a few µs of work each, so that no thread idles long
}

void for_blocks(std::int32_t count, int threads,
                const std::function<void(std::int32_t, std::int32_t)>& work) {
  std::atomic<std::int32_t> next = 0;
  const auto take_blocks = [&] {
    for (;;) {
      const std::int32_t begin = next.fetch_add(kBlock);
      if (begin >= count) return;
      work(begin, std::min(begin + kBlock, count));
    }
  };
  std::vector<std::jthread> helpers;
  const std::int32_t blocks = (count + kBlock - 1) / kBlock;
  for (int i = 1; i < std::min<std::int32_t>(threads, blocks); ++i)
    helpers.emplace_back(take_blocks);
  take_blocks();
}

}  // namespace meniscus::bem
