#pragma once

#include <string>
#include <string_view>

namespace meniscus::report {

/// Text escaped for HTML and SVG, also between quotes. Control characters, which XML cannot
/// contain, are left out.
[[nodiscard]] std::string markup_text(std::string_view text);

/// A number for readers: `digits` significant ones, a true minus sign, powers of ten as ×10ⁿ beyond
/// 10⁻⁴…10⁶; "–" when it is not finite.
[[nodiscard]] std::string number_text(double value, int digits = 4);

/// A number with a fixed count of decimals and a true minus sign, for columns of a table; "–" when
/// it is not finite.
[[nodiscard]] std::string decimal_text(double value, int decimals);

/// A whole number with thin spaces between thousands.
[[nodiscard]] std::string count_text(double value);

/// "0.35 s", "12.4 s", "3 min 05 s", "2 h 07 min".
[[nodiscard]] std::string duration_text(double seconds);

/// An integer in superscript digits: "⁻¹²".
[[nodiscard]] std::string superscript(int value);

}  // namespace meniscus::report
