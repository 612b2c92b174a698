#include "meniscus/report/text.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace meniscus::report {
namespace {

std::string with_true_minus(std::string text) {
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) {
    text.replace(at, 1, "−");
  }
  return text;
}

}  // namespace

std::string markup_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t') result += c;
    }
  }
  return result;
}

std::string superscript(int value) {
  static constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result;
  for (const char c : fmt::format("{}", value)) {
    result += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  }
  return result;
}

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const double magnitude = std::abs(value);
  if (magnitude >= 1e-4 && magnitude < 999999.5) {
    const int whole_digits = static_cast<int>(std::floor(std::log10(magnitude))) + 1;
    if (whole_digits >= digits) return with_true_minus(fmt::format("{:.0f}", value));
    return with_true_minus(fmt::format("{:.{}g}", value, digits));
  }
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = text.find('e');
  return with_true_minus(text.substr(0, e)) + "×10" + superscript(std::stoi(text.substr(e + 1)));
}

std::string decimal_text(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  // A number that rounds to zero has no sign.
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return with_true_minus(is_zero && text.starts_with('-') ? text.substr(1) : text);
}

std::string count_text(double value) {
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format("{:.0f}", std::abs(value));
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), "\u202f");
  }
  return value < 0.0 ? "−" + text : text;
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  if (seconds < 10.0) return fmt::format("{:.2f} s", seconds);
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace meniscus::report
