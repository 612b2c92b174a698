#pragma once

#include <malloc.h>

namespace meniscus {

/// Has the C library keep what is freed for what is asked for next, large arrays included, instead
/// of giving them back to the system, which clears their pages anew: of a million nodes, a second
/// solve so takes three quarters of the time of the first (docs/benchmark-stokes.md).
inline void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
}

}  // namespace meniscus
