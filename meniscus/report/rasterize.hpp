#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus::report {

/// A raster image with four bytes per pixel (blue, green, red, opacity), row after row from the
/// top.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

/// An .svg file of this program rendered on white at `scale` times its size, without a display.
/// Throws RunFailure with the library's reason.
[[nodiscard]] Pixels pixels_of(std::string_view svg, double scale);
/// The rendered picture as the bytes of a .png file.
[[nodiscard]] std::string png_of(std::string_view svg, double scale);

}  // namespace meniscus::report
