#include "meniscus/case/explain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "meniscus/case/schema.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using schema::Key;
using schema::Table;
using schema::Type;

constexpr std::string_view kOverrides =
    "The command line sets any key: `--set time.end=5`. Arrays of tables count from 0: "
    "`--set 'drop[1].nodes=200'`, `--set 'scalar[0].drop[1].partition=2'`. A single table needs no "
    "number: `--set drop.nodes=200`. The number after the last adds a table. Texts need quotes "
    "only where they look like a number, true, false or a list: `--set 'title=Two drops'`, "
    "`--set 'title=\"7\"'`, `--set 'drop[0].center=[0, 0, 1]'`.";

std::string allowed_values(const Key& key) {
  if (key.type == Type::word) return schema::quoted_list(key.words);
  const std::string range = schema::range_text(key.range);
  const bool is_vector = key.type == Type::vector;
  return fmt::format("{}{}{}", schema::description(key.type), range.empty() ? "" : ", ",
                     is_vector && !range.empty() ? "each " + range : range);
}

std::string default_text(const Key& key) {
  return key.value ? schema::to_toml(*key.value) : std::string(key.default_note);
}

std::string unit_text(const Key& key) {
  if (key.dimension == schema::Dimension::none) return "";
  return fmt::format("{} (with [scale]: {})", schema::unit(key.dimension),
                     schema::si_unit(key.dimension));
}

std::string header(const Table& table) {
  if (table.path.empty()) return "(top level)";
  const std::string name = schema::without_indices(table.path);
  return table.is_array ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

std::string explanation(const Key& key) {
  std::string text =
      fmt::format("{}\n  {}\n  value:   {}\n  default: {}\n", schema::without_indices(key.path),
                  key.sentence, allowed_values(key), default_text(key));
  if (const std::string unit = unit_text(key); !unit.empty())
    text += fmt::format("  unit:    {}\n", unit);
  if (!key.applies.empty()) text += fmt::format("  applies: {}\n", key.applies);
  return text;
}

/// The type as the page has it.
std::string_view short_description(Type type) {
  switch (type) {
    case Type::number:
      return "number";
    case Type::whole:
      return "whole number";
    case Type::text:
      return "text";
    case Type::path:
      return "file name";
    case Type::vector:
      return "vector";
    case Type::matrix:
      return "matrix";
    case Type::velocity:
      return "\"flow\" or [vx, vy, vz]";
    default:
      return schema::description(type);
  }
}

/// The range as the page has it: bounded ones as an interval.
std::string interval_text(const schema::Range& range) {
  if (!std::isfinite(range.min) || !std::isfinite(range.max)) return schema::range_text(range);
  return fmt::format("in {}{}, {}{}", range.open_min ? '(' : '[', range.min, range.max,
                     range.open_max ? ')' : ']');
}

/// "> 0, R0; default 1.0; with inertia": what the page says of a key besides its sentence.
std::string value_text(const Key& key) {
  const std::string range = interval_text(key.range);
  std::string text = key.type == Type::word ? schema::quoted_list(key.words)
                                            : std::string(short_description(key.type));
  if (key.type == Type::number && !range.empty())
    text = range;
  else if (!range.empty())
    text += " " + range;
  if (key.dimension != schema::Dimension::none)
    text += fmt::format(", {}", schema::unit(key.dimension));
  const bool is_required = key.default_note.starts_with("required");
  text += fmt::format("; {}{}", is_required ? "" : "default ", default_text(key));
  if (!key.applies.empty() && !key.default_note.ends_with(key.applies))
    text += fmt::format("; {}", key.applies);
  return text;
}

std::string entry(const Key& key) {
  return fmt::format("- `{}` ({}): {}\n", schema::leaf(key.path), value_text(key), key.sentence);
}

/// The first key that has the same name and entry as this one; this one where there is none before.
const Key& first_alike(const Key& key) {
  return *std::ranges::find_if(schema::keys(),
                               [&](const Key& other) { return entry(other) == entry(key); });
}

std::vector<const Key*> keys_of(const Table& table) {
  std::vector<const Key*> result;
  for (const Key& key : schema::keys())
    if (schema::parent_path(key.path) == table.path) result.push_back(&key);
  MENISCUS_ASSERT(!result.empty(), "table {} has no keys", table.path);
  return result;
}

/// The entries of a table's keys, and at the end the names of those that other tables explain.
std::string entries(const Table& table) {
  std::string text;
  std::map<std::string, std::vector<std::string>> explained;  // by the header of the other table
  for (const Key* key : keys_of(table)) {
    const Key& first = first_alike(*key);
    if (&first == key)
      text += entry(*key);
    else
      explained[header(*schema::find_table(schema::parent_path(first.path)))].push_back(
          fmt::format("`{}`", schema::leaf(key->path)));
  }
  for (const auto& [other, names] : explained)
    text += fmt::format("- {}: as in `{}`.\n", fmt::join(names, ", "), other);
  return text;
}

}  // namespace

std::string explain(std::string_view name) {
  const std::string wanted = schema::without_indices(name);
  std::string text;
  for (const Table& table : schema::tables())
    if (!wanted.empty() && schema::without_indices(table.path) == wanted) {
      text += fmt::format("{}\n  {}\n\n", header(table), table.sentence);
      for (const Key* key : keys_of(table)) text += explanation(*key);
    }
  if (!text.empty()) return text;
  for (const Key& key : schema::keys())
    if (schema::without_indices(key.path) == wanted) return explanation(key);
  for (const Key& key : schema::keys())
    if (schema::leaf(key.path) == wanted) text += explanation(key);
  if (!text.empty()) return text;
  const std::string near = schema::nearest_name(name);
  reject_input("explain: {}: unknown key; {}", name,
               near.empty() ? "`meniscus explain` lists all keys"
                            : fmt::format("did you mean \"{}\"?", near));
}

std::string explain() {
  std::string text;
  for (const Table& table : schema::tables()) {
    text += fmt::format("{}\n", header(table));
    for (const Key* key : keys_of(table))
      text += fmt::format("  {:<18} {}\n", schema::leaf(key->path), key->sentence);
  }
  return text + std::string(kOverrides) + "\n";
}

std::string reference_page() {
  std::string page =
      "# The case file\n\n"
      "Which keys does a case have? This page is made from `meniscus/case/schema_*.cpp`.\n\n"
      "A case is a TOML file. Only the flow's kind and each drop's shape have no default. Unknown "
      "keys and keys without effect are refused. Values are dimensionless, with a `[scale]` table "
      "in SI units; ranges hold for the dimensionless value. In brackets: value and unit; default; "
      "when the key applies. A vector is [x, y, z], a matrix three rows. Equations named here are "
      "those of hooper2001, the paper.\n\n";
  page += fmt::format("{}\n", kOverrides);
  for (const Table& table : schema::tables()) {
    const std::string heading =
        table.path.empty() ? "Top level" : fmt::format("`{}`", header(table));
    page += fmt::format("\n## {}\n\n{}\n\n", heading, table.sentence);
    page += entries(table);
  }
  return page;
}

}  // namespace meniscus
