#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "meniscus/core/vec.hpp"

namespace meniscus::schema {

/// The types of case-file keys.
enum class Type { number, whole, flag, word, text, path, vector, matrix, velocity };

/// The value of a key as given, in the case's own units. A `velocity` is a word or a vector.
using Value = std::variant<bool, std::int64_t, double, std::string, Vec3, Mat3>;

/// "a number", "three numbers [x, y, z]", …: ends the sentence "… must be".
[[nodiscard]] std::string_view description(Type type);
/// The value as TOML; reals with the fewest digits that read back to the same double.
[[nodiscard]] std::string to_toml(const Value& value);
/// The real numbers in a value, none for words and flags.
[[nodiscard]] std::vector<double> numbers_in(const Value& value);
/// The value with every real number multiplied by `factor`.
[[nodiscard]] Value scaled(const Value& value, double factor);

}  // namespace meniscus::schema
