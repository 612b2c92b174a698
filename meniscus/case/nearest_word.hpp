#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace meniscus {

/// The number of insertions, deletions, replacements and swaps of neighbours between two words.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word nearest to a misspelt one; empty when none is within a third of its length.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> words);

}  // namespace meniscus
