#pragma once

#include <cstdint>
#include <string_view>

namespace meniscus::io {

/// FNV-1a over 64 bits: any change of one byte changes it, any other with odds of 2⁻⁶⁴ against.
[[nodiscard]] std::uint64_t checksum(std::string_view bytes);

}  // namespace meniscus::io
