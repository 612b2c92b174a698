#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "meniscus/core/error.hpp"

namespace meniscus::io {

/// The value of type T at the start of `bytes` (at least sizeof(T) of them), of the given order.
template <class T>
[[nodiscard]] T load(std::string_view bytes, std::endian order) {
  MENISCUS_ASSERT(bytes.size() >= sizeof(T), "{} bytes for a value of {}", bytes.size(), sizeof(T));
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes.data(), sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(raw);
  return std::bit_cast<T>(raw);
}

/// Appends a value, lowest byte first.
template <class T>
void store(std::string& bytes, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (std::endian::native != std::endian::little) std::ranges::reverse(raw);
  bytes.append(raw.data(), raw.size());
}

}  // namespace meniscus::io
