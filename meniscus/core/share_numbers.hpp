#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace meniscus {

/// Finds the numbers of items first, …, end − 1, one item after the other. Must not throw: a rank
/// that throws alone would leave the others waiting.
using FindNumbers = std::function<std::vector<double>(std::size_t first, std::size_t end)>;
/// Gives the `width` numbers of each of `count` items, one item after the other. Ranks may each
/// find those of some of the items.
using ShareNumbers =
    std::function<std::vector<double>(std::size_t count, std::size_t width, const FindNumbers&)>;

/// Finds all numbers here.
[[nodiscard]] inline std::vector<double> own_numbers(std::size_t count, std::size_t /*width*/,
                                                     const FindNumbers& find) {
  return find(0, count);
}

}  // namespace meniscus
