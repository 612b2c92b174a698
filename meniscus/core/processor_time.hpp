#pragma once

#include <ctime>

namespace meniscus {

/// Seconds of processor time that this process has used, all its threads together.
[[nodiscard]] inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace meniscus
