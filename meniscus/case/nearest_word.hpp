#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace meniscus {

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word that a misspelt one most resembles; empty when none is within a third of its length.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> words);

}  // namespace meniscus
