#include "meniscus/case/explain.hpp"

#include <vector>

#include "meniscus/case/schema.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using schema::Key;
using schema::Table;
using schema::Type;

constexpr std::string_view kOverrides =
    "Any key can be set on the command line, as in `--set time.end=5`. A key of an array of tables "
    "takes the number of its table, counted from 0: `--set 'drop[1].nodes=200'`; it may be left "
    "out where there is one: `--set drop.nodes=200`. An array in an array has a number of its own: "
    "`--set 'scalar[0].drop[1].partition=2'`. The number after the last adds a table, "
    "provided that all it requires is set. Values are as in the file, but words and texts need "
    "no quotes of their own unless they could be read as a number, true, false or a list. What "
    "holds blanks, brackets or quotes is quoted as a whole for the shell: "
    "`--set 'title=Two drops'`, `--set 'title=\"7\"'`, `--set 'drop[0].center=[0, 0, 1]'`. Tables "
    "are set key by key.";

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

std::string table_row(const Key& key) {
  std::string sentence(key.sentence);
  if (!key.applies.empty()) sentence += fmt::format(" Applies {}.", key.applies);
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", schema::leaf(key.path), allowed_values(key),
                     unit_text(key), default_text(key), sentence);
}

std::vector<const Key*> keys_of(const Table& table) {
  std::vector<const Key*> result;
  for (const Key& key : schema::keys())
    if (schema::parent_path(key.path) == table.path) result.push_back(&key);
  MENISCUS_ASSERT(!result.empty(), "table {} has no keys", table.path);
  return result;
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
      "Made from the schema table in `meniscus/case/schema_*.cpp`; change it there.\n\n"
      "A case is a TOML file. Every key has a default except the flow's kind and each drop's "
      "shape. "
      "Values are dimensionless unless the case has a `[scale]` table. A key that would have no "
      "effect is refused, and so is one that is not listed here. With `[scale]`, ranges of keys "
      "with a unit hold for the dimensionless value.\n\n";
  page += fmt::format("{}\n", kOverrides);
  for (const Table& table : schema::tables()) {
    const std::string heading =
        table.path.empty() ? "Top level" : fmt::format("`{}`", header(table));
    page += fmt::format("\n## {}\n\n{}\n\n", heading, table.sentence);
    page += "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
    for (const Key* key : keys_of(table)) page += table_row(*key);
  }
  return page;
}

}  // namespace meniscus
