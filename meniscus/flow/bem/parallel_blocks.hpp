#pragma once

#include <cstdint>
#include <functional>

namespace meniscus::bem {

/// Calls work(begin, end) for blocks that partition [0, count), on up to `threads` threads. Which
/// thread takes which block is left to chance, so `work` must compute every index by itself.
void for_blocks(std::int32_t count, int threads,
                const std::function<void(std::int32_t begin, std::int32_t end)>& work);

}  // namespace meniscus::bem
