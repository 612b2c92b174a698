#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/case/document.hpp"
#include "meniscus/case/schema.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {

/// SI values of the dimensionless units, for a case with [scale].
struct Scale {
  double length = 1.0;           ///< R0 [m]
  double viscosity = 1.0;        ///< μ_out [Pa s]
  double surface_tension = 1.0;  ///< σ [N/m]
  double rate = 1.0;             ///< G [1/s]
  double density = 0.0;          ///< ρ_out [kg/m³]; 0: not known

  /// The dimensionless unit of a dimension, in SI units.
  [[nodiscard]] double unit(schema::Dimension dimension) const;
};

/// The values of a case: as given, else the schema's defaults. Numbers are returned dimensionless.
/// Records which keys were read, so that a key without effect can be refused. It records the source
/// of each, so that later checks can name the line.
class Settings {
 public:
  Settings() = default;
  explicit Settings(schema::Document document) : document_(std::move(document)) {}

  [[nodiscard]] bool is_given(const std::string& path) const {
    return document_.values.contains(path);
  }
  [[nodiscard]] bool has_table(const std::string& path) const {
    return document_.tables.contains(path);
  }
  [[nodiscard]] int count(const std::string& array) const { return document_.count(array); }

  /// The value of a key by type. Each function throws InvalidInput when a required key is missing.
  [[nodiscard]] double number(const std::string& path);
  [[nodiscard]] int whole(const std::string& path);
  [[nodiscard]] bool flag(const std::string& path);
  [[nodiscard]] std::string text(const std::string& path);
  [[nodiscard]] Vec3 vector(const std::string& path);
  [[nodiscard]] Mat3 matrix(const std::string& path);
  /// The word of a `velocity` key; none when its value is three numbers.
  [[nodiscard]] std::optional<std::string> word_or_vector(const std::string& path);
  /// A file name. Relative names start from the case file's folder, those of --set from the current
  /// folder. Whether the file exists is checked when it is read.
  [[nodiscard]] std::filesystem::path file(const std::string& path);
  /// A number whose dimensionless default `fallback` follows from other keys.
  [[nodiscard]] double number_or(const std::string& path, double fallback);
  /// The meaning of a key's word, from a list of words (case/words.hpp).
  template <class Words>
  [[nodiscard]] auto choice(const std::string& path, const Words& words);

  /// Makes `value` the default of a key that was not given, here and in checkpoints.
  void prefer(const std::string& path, const schema::Value& value) {
    if (!is_given(path)) used_[path] = value;
  }

  /// Throws InvalidInput, with [scale], where a length of `largest` R0 is above `most`: it was not
  /// given in metres.
  void require_metres(const std::string& path, double largest, double most) const;

  void set_scale(const Scale& scale) { scale_ = scale; }
  [[nodiscard]] const std::optional<Scale>& scale() const { return scale_; }
  /// What a dimensionless number is multiplied by to be in the case's own units: 1 without [scale].
  [[nodiscard]] double unit(schema::Dimension dimension) const {
    return scale_ ? scale_->unit(dimension) : 1.0;
  }

  /// The source of a key such as "case.toml:7", else of the nearest table around it, else
  /// "case.toml".
  [[nodiscard]] std::string source(const std::string& path) const;
  /// Whether an array's table, "drop[1]", was begun by --set.
  [[nodiscard]] bool is_added(const std::string& table) const {
    return document_.added_tables.contains(table);
  }
  /// The key as messages write it after its source.
  [[nodiscard]] std::string name(const std::string& path) const;
  /// Throws InvalidInput: "case.toml:7: drop.radius = 2.0 <complaint>".
  template <class... Args>
  [[noreturn]] void reject(const std::string& path, fmt::format_string<Args...> format,
                           Args&&... args) const {
    reject_value(path, fmt::format(format, std::forward<Args>(args)...));
  }
  /// Throws InvalidInput naming the first given key that was never read. Keys of the file that are
  /// used without overrides are exempt: an override removed their effect.
  void require_all_used(const std::map<std::string, schema::Value>& used_without_overrides) const;

  /// Every key that was read, with its value (given or default) in the case's own units, by path.
  [[nodiscard]] const std::map<std::string, schema::Value>& used() const { return used_; }

 private:
  [[noreturn]] void reject_value(const std::string& path, const std::string& complaint) const;
  /// The value (given or default) in the case's own units.
  const schema::Value& own_value(const std::string& path);
  /// The dimensionless value. Throws InvalidInput when it is not in the key's range.
  schema::Value dimensionless_value(const std::string& path);
  [[nodiscard]] double unit_of(const std::string& path) const;

  schema::Document document_;
  std::optional<Scale> scale_;
  std::map<std::string, schema::Value> used_;
};

template <class Words>
auto Settings::choice(const std::string& path, const Words& words) {
  const std::string given = text(path);
  for (const auto& [word, meaning] : words)
    if (word == given) return meaning;
  MENISCUS_ASSERT(false, "{} = {}: a word of the schema without a meaning", path, given);
  return words[0].meaning;
}

}  // namespace meniscus
