#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace meniscus::report {

/// Bytes as text in base 64, which a browser's `atob` reads.
[[nodiscard]] std::string base64(std::string_view bytes);

/// Compressed bytes in zlib's format (RFC 1950), which browsers call `deflate`. Equal input gives
/// equal output.
[[nodiscard]] std::string zlib_bytes(std::string_view bytes);

/// A grid of 16-bit numbers between two bounds: 0 stands for `low`, `steps` for `high`. The error
/// is at most half of (high − low)/steps. Values that are not finite become `none`.
struct Grid16 {
  static constexpr std::uint16_t steps = 65534, none = 65535;
  double low = 0.0, high = 0.0;

  /// The grid that spans the finite values; [0, 0] when there are none.
  [[nodiscard]] static Grid16 around(std::span<const double> values);
  [[nodiscard]] std::uint16_t index(double value) const;
};

/// Binary data for the page. It has the length of a header in bytes (32 bits, lowest byte first),
/// the header in JSON, then arrays in the order added. Numbers of several bytes are stored in
/// planes, the lowest bytes of all numbers first: high bytes are alike and compress well.
class Package {
 public:
  explicit Package(std::string_view header);
  void add(std::span<const std::uint8_t> values) { add_planes(values); }
  void add(std::span<const std::uint16_t> values) { add_planes(values); }
  void add(std::span<const std::uint32_t> values) { add_planes(values); }
  /// Adds the difference of each number to the one before (the first: to 0), modulo 2^16.
  /// Differences are small where neighbours are alike.
  void add_differences(std::span<const std::uint16_t> values);
  /// The whole package, compressed.
  [[nodiscard]] std::string bytes() const { return zlib_bytes(bytes_); }

 private:
  template <class T>
  void add_planes(std::span<const T> values);

  std::string bytes_;
};

}  // namespace meniscus::report
