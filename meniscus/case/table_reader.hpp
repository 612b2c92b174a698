#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "meniscus/core/error.hpp"

namespace meniscus {

/// Parses TOML, which messages call `name`. Throws InvalidInput naming name and line where it is
/// none.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& name);
/// The same of a file.
[[nodiscard]] toml::table parse_toml_file(const std::filesystem::path& file);

/// A value as TOML on one line; "a table" for a table.
[[nodiscard]] std::string toml_text(const toml::node& node);

/// Reads one table of a file that goes with cases, such as check.toml, and reports its faults as
/// InvalidInput with file, line and key. Lives no longer than the table.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  template <class... T>
  [[noreturn]] void reject(const toml::node& node, fmt::format_string<T...> what,
                           T&&... arguments) const {
    reject_input("{}:{}: {}", file_, node.source().begin.line,
                 fmt::format(what, std::forward<T>(arguments)...));
  }

  /// Throws InvalidInput at a key that is not one of these.
  void allow(std::initializer_list<std::string_view> keys) const;

  template <class T>
  [[nodiscard]] std::optional<T> find(std::string_view key, const char* kind) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    std::optional<T> value = node->value<T>();
    if (!value) reject(*node, "{}: {} is wanted", key, kind);
    return value;
  }
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const {
    return find<std::string>(key, "a text");
  }
  [[nodiscard]] std::optional<double> number(std::string_view key) const {
    return find<double>(key, "a number");
  }
  [[nodiscard]] std::optional<int> whole(std::string_view key) const {
    return find<int>(key, "a whole number");
  }
  [[nodiscard]] bool flag(std::string_view key) const {
    return find<bool>(key, "true or false").value_or(false);
  }

  template <class T>
  [[nodiscard]] std::vector<T> list(std::string_view key, const char* kind) const {
    std::vector<T> values;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return values;
    if (!node->is_array()) reject(*node, "{}: a list of {} is wanted", key, kind);
    for (const toml::node& entry : *node->as_array()) {
      const std::optional<T> value = entry.value<T>();
      if (!value) reject(entry, "{}: a list of {} is wanted", key, kind);
      values.push_back(*value);
    }
    return values;
  }

  [[nodiscard]] std::string required_text(std::string_view key) const {
    const std::optional<std::string> value = text(key);
    if (!value || value->empty()) reject(table_, "{}: is missing", key);
    return *value;
  }

  /// The line of a key, else of the table: "study.toml:7".
  [[nodiscard]] std::string source(std::string_view key = "") const {
    const toml::node* node = table_.get(key);
    return fmt::format("{}:{}", file_,
                       (node == nullptr ? table_.source() : node->source()).begin.line);
  }

  /// The tables of an array of tables.
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key) const {
    std::vector<TableReader> readers;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return readers;
    if (!node->is_array_of_tables()) reject(*node, "{}: write [[{}]]", key, key);
    for (const toml::node& entry : *node->as_array())
      readers.emplace_back(*entry.as_table(), file_);
    return readers;
  }

  [[nodiscard]] const toml::table& table() const { return table_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  const toml::table& table_;
  std::string file_;
};

}  // namespace meniscus
