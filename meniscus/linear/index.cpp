#include "meniscus/linear/index.hpp"

#include <limits>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"

namespace meniscus::linear {

std::int32_t checked_index(std::int64_t value, std::string_view things) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  MENISCUS_ASSERT(value >= 0, "{} {}", value, things);
  if (value > kMost)
    throw RunFailure(fmt::format(
        "the flow problem has {} {} on one process: at most {} can be numbered with 32 bits; use "
        "more processes or a coarser mesh",
        value, things, kMost));
  return static_cast<std::int32_t>(value);
}

}  // namespace meniscus::linear
