#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meniscus/case/value.hpp"

namespace meniscus::schema {

/// The dimension of a key; with [scale] its value is in SI units and converted by this.
enum class Dimension { none, length, time, rate, velocity, stress, force_density, gravity };

/// Allowed numbers (each component of a vector), dimensionless. NaN is never allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;  ///< min itself is not allowed
  bool open_max = false;
  bool infinity = false;  ///< +inf is allowed
};

/// One row of the table from which validation, `explain`, defaults and the reference page are made.
struct Key {
  std::string_view path;  ///< "drop[].radius": [] stands for the index in an array of tables
  Type type = Type::number;
  Dimension dimension = Dimension::none;
  Range range = {};
  std::vector<std::string_view> words = {};  ///< allowed words of a `word`
  std::optional<Value> value = {};           ///< the default; none: see `default_note`
  std::string_view default_note = {};        ///< "required", or how the default follows from others
  std::string_view applies = {};  ///< the cases in which the key has an effect; empty: all
  std::string_view sentence = {};
};

/// A table of the case file: its path, whether it is an array of tables, and what it is about.
struct Table {
  std::string_view path;
  bool is_array = false;
  std::string_view sentence = {};
};

[[nodiscard]] std::span<const Table> tables();  ///< in the order of the reference page
[[nodiscard]] std::span<const Key> keys();      ///< in the order of the tables
/// The key or table of a generic path; null when there is none.
[[nodiscard]] const Key* find_key(std::string_view path);
[[nodiscard]] const Table* find_table(std::string_view path);

/// "drop[3].radius" → "drop[].radius".
[[nodiscard]] std::string generic_path(std::string_view path);
/// "drop[].radius" → "drop.radius": as in a case file, where the line names the drop.
[[nodiscard]] std::string without_indices(std::string_view path);
/// "drop[].radius" → "drop[]" (its table, "" at the top) and "radius".
[[nodiscard]] std::string_view parent_path(std::string_view path);
[[nodiscard]] std::string_view leaf(std::string_view path);

/// The unit of a dimension as "R0", "1/G", …; empty without dimension. `si_unit` gives "m", "s", …
[[nodiscard]] std::string_view unit(Dimension dimension);
[[nodiscard]] std::string_view si_unit(Dimension dimension);
/// The range in words, such as "> 0 or inf", "at least 12" or "between 0 and 1, both excluded";
/// empty when every number is allowed.
[[nodiscard]] std::string range_text(const Range& range);
[[nodiscard]] bool is_within(const Range& range, double value);
/// The words in quotes, separated by commas.
[[nodiscard]] std::string quoted_list(std::span<const std::string_view> words);

/// Why a value is not in the key's range, such as "must be > 0" or "must be finite and at least 0".
/// It is empty when it is.
[[nodiscard]] std::string range_complaint(const Key& key, const Value& value);
/// Throws InvalidInput unless the value is in the key's range or words. For a key with a dimension
/// it only requires a finite value: `Settings` checks the range once [scale] is known. The message
/// begins with `source` ("case.toml:7" or "--set …") and `name` (the key as the user wrote it).
void check_value(const Key& key, const Value& value, std::string_view source,
                 std::string_view name);
/// Throws InvalidInput about an unknown key, with the nearest valid one.
[[noreturn]] void reject_unknown_key(std::string_view path, std::string_view source);
/// The key or table of the schema nearest to a path, as written in a case file; empty when nothing
/// is near.
[[nodiscard]] std::string nearest_name(std::string_view path);

}  // namespace meniscus::schema
