#pragma once

#include <malloc.h>

namespace meniscus {

/// Makes the C library keep freed memory, large arrays included, for later allocations. The system
/// need not clear its pages again. With a million nodes a second solve then takes three quarters of
/// the time of the first (docs/benchmark-stokes.md).
inline void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
}

}  // namespace meniscus
