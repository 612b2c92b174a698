#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "meniscus/core/processor_time.hpp"

namespace meniscus {

/// Bytes per second of a[i] = b[i] + s c[i] on arrays far larger than any cache (the triad of
/// STREAM): the best of several passes, 24 bytes counted per element.
inline double memory_bandwidth() {
  constexpr std::size_t kLength = 8'000'000;  // 64 MB each
  constexpr int kPasses = 8;
  std::vector<double> a(kLength, 0.0), b(kLength, 1.0), c(kLength, 2.0);
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    const double start = processor_seconds(), s = 1.0 / (pass + 1);
    for (std::size_t i = 0; i < kLength; ++i) a[i] = b[i] + s * c[i];
    least = std::min(least, processor_seconds() - start);
    std::swap(a, b);
  }
  return 24.0 * kLength / least;
}

}  // namespace meniscus
