#pragma once

#include <string>
#include <vector>

namespace meniscus::report {

/// The marks of an axis, and the range it covers: from the first value to the last or beyond.
struct Ticks {
  double min = 0.0, max = 1.0;
  std::vector<double> values = {};
  std::vector<std::string> labels = {};
  std::string factor = {};  ///< "×10⁻³" when all labels are to be multiplied by it; else empty
};

/// About `count` marks at 1, 2 or 5 times a power of ten around [low, high], both within ±1e300.
/// The range ends at marks when `is_rounded`, else at the data. A range without extent is widened.
[[nodiscard]] Ticks linear_ticks(double low, double high, int count, bool is_rounded = true);

/// Marks at powers of ten around [low, high], 1e-300 < low ≤ high < 1e300. A short range also has
/// marks at 2 and 5 times these powers.
[[nodiscard]] Ticks log_ticks(double low, double high);

}  // namespace meniscus::report
