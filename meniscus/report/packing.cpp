#include "meniscus/report/packing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <zlib.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/binary.hpp"

namespace meniscus::report {

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? digits[(group >> (6 * (3 - k))) & 63U] : '=';
    }
  }
  return text;
}

std::string zlib_bytes(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  // 6 is zlib's default: 9 takes three times as long to save one per cent.
  [[maybe_unused]] const int status =
      compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  MENISCUS_ASSERT(status == Z_OK, "zlib returned {}", status);
  result.resize(size);
  return result;
}

Grid16 Grid16::around(std::span<const double> values) {
  Grid16 grid{HUGE_VAL, -HUGE_VAL};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    grid.low = std::min(grid.low, value);
    grid.high = std::max(grid.high, value);
  }
  return grid.low <= grid.high ? grid : Grid16{};
}

std::uint16_t Grid16::index(double value) const {
  if (!std::isfinite(value)) return none;
  if (!(high > low)) return 0;
  // Halves each number first, so that the difference of large numbers does not overflow.
  const double share = (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low);
  return static_cast<std::uint16_t>(std::lround(steps * std::clamp(share, 0.0, 1.0)));
}

Package::Package(std::string_view header) {
  io::store(bytes_, static_cast<std::uint32_t>(header.size()));
  bytes_ += header;
}

template <class T>
void Package::add_planes(std::span<const T> values) {
  for (unsigned int shift = 0; shift < 8 * sizeof(T); shift += 8) {
    for (const T value : values) bytes_ += static_cast<char>((value >> shift) & 0xFFU);
  }
}

template void Package::add_planes(std::span<const std::uint8_t>);
template void Package::add_planes(std::span<const std::uint16_t>);
template void Package::add_planes(std::span<const std::uint32_t>);

void Package::add_differences(std::span<const std::uint16_t> values) {
  std::vector<std::uint16_t> differences;
  std::uint16_t before = 0;
  for (const std::uint16_t value : values) {
    differences.push_back(static_cast<std::uint16_t>(value - before));
    before = value;
  }
  add(differences);
}

}  // namespace meniscus::report
