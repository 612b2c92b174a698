#include "meniscus/report/ticks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

/// 1, 2 or 5 times a power of ten, the least not below `step`.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    // Roundoff of the division must not push 2.0000000001 to 5.
    if (step <= factor * power * (1.0 + 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

/// The exponent that labels share: 0 unless they would have many zeros.
int common_exponent(double largest) {
  if (largest == 0.0 || (largest >= 1e-2 && largest < 1e5)) return 0;
  return static_cast<int>(std::floor(std::log10(largest)));
}

std::string label(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

/// Widens a range that is a point, or so thin that neighbouring marks would be the same double.
void widen(double& low, double& high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-9 * largest && high > low) return;
  const double half = largest > 0.0 ? 0.1 * largest : 1.0;
  low -= half;
  high += half;
}

}  // namespace

Ticks linear_ticks(double low, double high, int count, bool is_rounded) {
  widen(low, high);
  const double step = nice_step((high - low) / count);
  // A thousandth of a step: a mark that the data miss by roundoff is still theirs.
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
  const double first = std::floor(std::log10(low) + 1e-9),
               last = std::ceil(std::log10(high) - 1e-9);
  const double end = std::max(last, first + 1.0);
  Ticks ticks{.min = std::pow(10.0, first), .max = std::pow(10.0, end)};
  const double stride = std::ceil((end - first) / 6.0);  // more than about six labels crowd
  for (double exponent = first; exponent <= end; exponent += stride) {
    ticks.values.push_back(std::pow(10.0, exponent));
    ticks.labels.push_back("10" + superscript(static_cast<int>(exponent)));
  }
  return ticks;
}

}  // namespace meniscus::report
