#include "meniscus/report/ticks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

/// The smallest of 1, 2 or 5 times a power of ten that is not below `step`.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    // Roundoff of the division must not push 2.0000000001 to 5.
    if (step <= factor * power * (1.0 + 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

/// The exponent that all labels share: 0 unless they would have many zeros.
int common_exponent(double largest) {
  if (largest == 0.0 || (largest >= 1e-2 && largest < 1e5)) return 0;
  return static_cast<int>(std::floor(std::log10(largest)));
}

std::string label(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

/// Widens a range that is a point, or so narrow that neighbouring marks would be the same double.
void widen(double& low, double& high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (high - low > std::max(1e-9 * largest, 1e-300)) return;
  const double half = largest > 1e-300 ? 0.1 * largest : 1.0;  // below 1e-300 reciprocals overflow
  low -= half;
  high += half;
}

}  // namespace

Ticks linear_ticks(double low, double high, int count, bool is_rounded) {
  MENISCUS_ASSERT(count > 0 && low <= high, "{} ticks from {:g} to {:g}", count, low, high);
  widen(low, high);
  const double step = nice_step((high - low) / count);
  // Tolerance of a thousandth of a step: roundoff of the data must not lose a mark.
  const double first = std::floor(low / step + 1e-3), last = std::ceil(high / step - 1e-3);
  Ticks ticks{.min = is_rounded ? first * step : low, .max = is_rounded ? last * step : high};
  const int exponent = common_exponent(std::max(std::abs(ticks.min), std::abs(ticks.max)));
  const double unit = std::pow(10.0, exponent);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)));
  for (double k = first; k <= last; ++k) {
    const double value = k * step;
    const double slack = 1e-3 * step;
    if (value < ticks.min - slack || value > ticks.max + slack) continue;
    ticks.values.push_back(value);
    ticks.labels.push_back(label(value / unit, decimals));
  }
  if (exponent != 0) ticks.factor = "×10" + superscript(exponent);
  return ticks;
}

Ticks log_ticks(double low, double high) {
  MENISCUS_ASSERT(low > 0.0 && low <= high, "logarithmic ticks from {:g} to {:g}", low, high);
  const double first = std::floor(std::log10(low) + 1e-9),
               last = std::ceil(std::log10(high) - 1e-9);
  const bool is_short = last - first <= 2.0;
  // An axis has room for about six labels.
  const double stride = is_short ? 1.0 : std::ceil((last - first) / 6.0);
  Ticks ticks;
  for (double exponent = first; exponent <= last + stride; exponent += stride) {
    const double power = std::pow(10.0, exponent);
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor > 1.0 && !is_short) break;
      const double value = factor * power;
      const bool is_enough = ticks.values.size() > 1 && ticks.values.back() > high * (1.0 - 1e-9);
      if (is_enough) break;
      if (value <= low * (1.0 + 1e-9)) ticks = {};
      ticks.values.push_back(value);
      ticks.labels.push_back(is_short ? number_text(value, 1)
                                      : "10" + superscript(static_cast<int>(exponent)));
    }
  }
  ticks.min = ticks.values.front();
  ticks.max = ticks.values.back();
  return ticks;
}

}  // namespace meniscus::report
