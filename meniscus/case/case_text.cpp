#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;
using schema::Value;

/// A table of the case, "flow" or "scalar[0].drop[1]", with its values.
struct UsedTable {
  std::string path;
  bool is_array = false;
  std::vector<std::pair<std::string, const Value*>>
      values;  // by the name of the key within the table
};

UsedTable used_table(const Case& c, const schema::Table& table, const std::string& path) {
  UsedTable result{path, table.is_array, {}};
  for (const schema::Key& key : schema::keys()) {
    if (schema::parent_path(key.path) != table.path) continue;
    MENISCUS_ASSERT(schema::find_table(table.path) != nullptr, "no table {}", table.path);
    const std::string name(schema::leaf(key.path));
    const auto used =
        c.settings.used().find(path.empty() ? name : fmt::format("{}.{}", path, name));
    if (used != c.settings.used().end()) result.values.emplace_back(name, &used->second);
  }
  return result;
}

/// Appends a table, "scalar[0]", if it has values or belongs to an array, and then those in it.
void append_tables(const Case& c, const schema::Table& table, const std::string& path,
                   std::vector<UsedTable>& result) {
  result.push_back(used_table(c, table, path));
  if (!table.is_array && result.back().values.empty()) result.pop_back();
  for (const schema::Table& inner : schema::tables()) {
    if (inner.path.empty() || schema::parent_path(inner.path) != table.path) continue;
    std::string name(schema::leaf(inner.path));
    if (inner.is_array) name.resize(name.size() - 2);  // without "[]"
    if (!path.empty()) name = fmt::format("{}.{}", path, name);
    if (!inner.is_array) append_tables(c, inner, name, result);
    for (int i = 0; inner.is_array && i < c.settings.count(name); ++i)
      append_tables(c, inner, fmt::format("{}[{}]", name, i), result);
  }
}

/// All tables with values, in the order of the schema; what is in a table follows it.
std::vector<UsedTable> used_tables(const Case& c) {
  std::vector<UsedTable> result;
  append_tables(c, *schema::find_table(""), "", result);
  return result;
}

Json to_json(const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* real = std::get_if<double>(&value))
    return std::isinf(*real) ? Json("inf") : Json(*real);  // JSON has no infinity
  if (const auto* v = std::get_if<Vec3>(&value)) return {v->x(), v->y(), v->z()};
  Json rows = Json::array();
  const Mat3& m = std::get<Mat3>(value);
  for (int i = 0; i < 3; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2)});
  return rows;
}

/// "/scalar/0/drop/1" for "scalar[0].drop[1]".
Json::json_pointer pointer(const std::string& path) {
  std::string text;
  for (const char c : path)
    if (c == '.' || c == '[')
      text += '/';
    else if (c != ']')
      text += c;
  return Json::json_pointer(text.empty() ? "" : "/" + text);
}

}  // namespace

std::string case_toml(const Case& c) {
  std::string text;
  for (const UsedTable& table : used_tables(c)) {
    const std::string name = schema::without_indices(table.path);
    if (!name.empty())
      text += fmt::format("\n{1}{0}{2}\n", name, table.is_array ? "[[" : "[",
                          table.is_array ? "]]" : "]");
    for (const auto& [key, value] : table.values)
      text += fmt::format("{} = {}\n", key, schema::to_toml(*value));
  }
  return text;
}

std::string case_json(const Case& c) {
  Json json = Json::object();
  for (const UsedTable& table : used_tables(c))
    for (const auto& [key, value] : table.values) json[pointer(table.path) / key] = to_json(*value);
  return json.dump(2);
}

}  // namespace meniscus
