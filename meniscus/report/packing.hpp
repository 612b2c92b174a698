#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace meniscus::report {

/// The text of bytes in base 64, as a page can hold and a browser's `atob` read them.
[[nodiscard]] std::string base64(std::string_view bytes);

/// Bytes in the format zlib (RFC 1950), which browsers call `deflate`. The same bytes always give
/// the same.
[[nodiscard]] std::string deflated(std::string_view bytes);

/// Numbers on a grid of 16 bits between two bounds: 0 stands for `low`, `steps` for `high`, the
/// error is at most half of (high − low)/steps. What is not finite becomes `none`.
struct Grid16 {
  static constexpr std::uint16_t steps = 65534, none = 65535;
  double low = 0.0, high = 0.0;

  /// The grid that the finite values need; [0, 0] without any.
  [[nodiscard]] static Grid16 around(std::span<const double> values);
  [[nodiscard]] std::uint16_t index(double value) const;
};

/// Binary data for the page: the length of a header in bytes (32 bits, lowest byte first), the
/// header in JSON, then arrays in the order added. Those of more than a byte are laid out in
/// planes, the lowest byte of all numbers first: high bytes are much alike, and deflate well.
class Package {
 public:
  explicit Package(std::string_view header);
  void add(std::span<const std::uint8_t> values) { add_planes(values); }
  void add(std::span<const std::uint16_t> values) { add_planes(values); }
  void add(std::span<const std::uint32_t> values) { add_planes(values); }
  /// Each number less the one before it (the first less 0), modulo 2^16: small where neighbours are
  /// alike.
  void add_differences(std::span<const std::uint16_t> values);
  /// All of it, deflated.
  [[nodiscard]] std::string bytes() const { return deflated(bytes_); }

 private:
  template <class T>
  void add_planes(std::span<const T> values);

  std::string bytes_;
};

}  // namespace meniscus::report
