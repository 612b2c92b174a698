#include "meniscus/case/document.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "meniscus/case/schema.hpp"
#include "meniscus/case/table_reader.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus::schema {
namespace {

/// What the user wrote, shortened to fit into a message.
std::string excerpt(const toml::node& node) {
  const std::string text = toml_text(node);
  constexpr std::size_t kLongest = 60;  // so that a message stays on one line
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "…";
}

std::optional<double> real(const toml::node& node) {
  if (node.is_integer() || node.is_floating_point()) return node.value<double>();
  return std::nullopt;
}

std::optional<Vec3> vector3(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) return std::nullopt;
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> component = real(*array->get(i));
    if (!component) return std::nullopt;
    result[static_cast<Eigen::Index>(i)] = *component;
  }
  return result;
}

std::optional<Mat3> matrix3(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) return std::nullopt;
  Mat3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Vec3> row = vector3(*array->get(i));
    if (!row) return std::nullopt;
    result.row(static_cast<Eigen::Index>(i)) = *row;
  }
  return result;
}

template <class T>
std::optional<Value> as_value(std::optional<T> found) {
  if (!found) return std::nullopt;
  return Value(std::move(*found));
}

std::optional<Value> convert(const toml::node& node, Type type) {
  switch (type) {
    case Type::number:
      return as_value(real(node));
    case Type::whole:
      return as_value(node.value_exact<std::int64_t>());
    case Type::flag:
      return as_value(node.value_exact<bool>());
    case Type::word:
    case Type::text:
    case Type::path:
      return as_value(node.value_exact<std::string>());
    case Type::vector:
      return as_value(vector3(node));
    case Type::matrix:
      return as_value(matrix3(node));
    case Type::velocity:
      return node.is_string() ? as_value(node.value_exact<std::string>()) : as_value(vector3(node));
  }
  return std::nullopt;
}

Value checked_value(const Key& key, const toml::node& node, std::string_view source,
                    std::string_view name) {
  const std::optional<Value> value = convert(node, key.type);
  if (!value)
    reject_input("{}: {} = {} must be {}", source, name, excerpt(node),
                 key.type == Type::word ? "one of " + quoted_list(key.words)
                                        : std::string(description(key.type)));
  check_value(key, *value, source, name);
  return *value;
}

/// Walks the tables of a parsed file into flat paths.
class Flattener {
 public:
  explicit Flattener(Document& document) : document_(document) {}

  void table(const toml::table& table, const std::string& path) {
    for (const auto& [name, node] : table) {
      const std::string child =
          path.empty() ? std::string(name.str()) : fmt::format("{}.{}", path, name.str());
      entry(node, child, source(name.source()));
    }
  }

 private:
  std::string source(const toml::source_region& region) const {
    return fmt::format("{}:{}", document_.name, region.begin.line);
  }

  void entry(const toml::node& node, const std::string& path, const std::string& where) {
    const std::string generic = generic_path(path), plain = without_indices(path);
    if (find_table(generic + "[]") != nullptr) return array(node, path, where);
    if (find_table(generic) != nullptr) {
      if (!node.is_table()) reject_input("{}: {} must be a table: [{}]", where, plain, plain);
      document_.tables[path] = where;
      return table(*node.as_table(), path);
    }
    const Key* key = find_key(generic);
    if (key == nullptr) reject_unknown_key(plain, where);
    document_.values[path] = Given{checked_value(*key, node, where, plain), where};
  }

  void array(const toml::node& node, const std::string& path, const std::string& where) {
    const std::string plain = without_indices(path);
    const toml::array* tables = node.as_array();
    if (tables == nullptr || !std::ranges::all_of(*tables, &toml::node::is_table))
      reject_input("{}: {} must be an array of tables: [[{}]]", where, plain, plain);
    for (std::size_t i = 0; i < tables->size(); ++i) {
      const std::string element = fmt::format("{}[{}]", path, i);
      document_.tables[element] = source(tables->get(i)->source());
      table(*tables->get(i)->as_table(), element);
    }
  }

  Document& document_;
};

/// The value of an override: TOML, or a word without quotes.
toml::table parse_override_value(const std::string& value) {
  try {
    toml::table table = toml::parse("value = " + value);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {  // not TOML: taken as a word below
  }
  return toml::table{{"value", value}};
}

/// Adds the array table that a path such as "drop[1].radius" begins. It must be the next one.
void require_tables(Document& document, const std::string& path, const std::string& source) {
  for (std::size_t close = path.find(']'); close != std::string::npos;
       close = path.find(']', close + 1)) {
    const std::string element = path.substr(0, close + 1);
    if (document.tables.contains(element)) continue;
    const std::string array = element.substr(0, element.rfind('['));
    const int count = document.count(array);
    if (element != fmt::format("{}[{}]", array, count))
      reject_input("{}: {} does not exist; the next to add is {}[{}]", source, element, array,
                   count);
    document.tables[element] = source;
    document.added_tables.insert(element);
  }
}

/// The parts of a path with their dots: "scalar[0]", ".drop", ".source".
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < path.size(); begin += parts.back().size())
    parts.push_back(path.substr(begin, path.find('.', begin + 1) - begin));
  return parts;
}

/// Whether a path ends with the name of an array of tables, without an index.
bool is_array(const std::string& path) { return find_table(generic_path(path) + "[]") != nullptr; }

/// The generic path with the brackets that may be left out: "drop[].nodes" for "drop.nodes".
std::string with_brackets(const std::string& path) {
  std::string result;
  for (const std::string& part : parts_of(generic_path(path))) {
    result += part;
    if (is_array(result)) result += "[]";
  }
  return result;
}

/// The path with the indices that it leaves out: "scalar[0].drop[1].source" for
/// "scalar.drop[1].source".
std::string indexed_path(const Document& document, const std::string& path,
                         const std::string& source) {
  if (find_key(with_brackets(path)) == nullptr) return path;
  std::string result;
  std::size_t length = 0;  // of what is read of the path
  for (const std::string& part : parts_of(path)) {
    result += part;
    length += part.size();
    if (!is_array(result)) continue;
    const int count = document.count(result);
    if (count != 1)
      reject_input("{}: {}: there are {} [[{}]]; say which by an index, as in {}[0]{}", source,
                   path, count, without_indices(result), result, path.substr(length));
    result += "[0]";
  }
  return result;
}

/// The nearest key, "drop.nodes", as `path` would name it: with the indices that it gives, and with
/// [0] where an array has not one table.
std::string suggestion(const Document& document, const std::string& near, const std::string& path) {
  std::string result, table;  // as suggested, and with all indices
  for (const std::string& part : parts_of(near)) {
    result += part;
    table += part;
    if (!is_array(table)) continue;
    const std::size_t close = path.find(']', result.size());
    const bool has_index = path.starts_with(result + "[") && close != std::string::npos;
    const std::string index =
        has_index ? path.substr(result.size(), close + 1 - result.size()) : "[0]";
    if (has_index || document.count(table) != 1) result += index;
    table += index;
  }
  return result;
}

/// Throws InvalidInput for a key that is not in the schema, and suggests one that is.
[[noreturn]] void reject_unknown_override(const Document& document, const std::string& path,
                                          const std::string& source) {
  const auto is_table = [](const std::string& name) {
    return find_table(with_brackets(name)) != nullptr;
  };
  if (is_table(path))
    reject_input("{}: {} is a table; set its keys one by one, as in --set flow.kind=quiescent",
                 source, path);
  const std::string near = nearest_name(path);
  if (near.empty()) reject_input("{}: {}: unknown key", source, path);
  if (is_table(near))
    reject_input("{}: {}: unknown key; did you mean a key of \"{}\"?", source, path, near);
  reject_input("{}: {}: unknown key; did you mean \"{}\"?", source, path,
               suggestion(document, near, path));
}

void apply_override(Document& document, const std::string& option) {
  const std::string source = "--set " + option;
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == option.size())
    reject_input("{}: expected key=value, as in --set drop[0].nodes=200", source);
  const std::string path = indexed_path(document, option.substr(0, equals), source);
  const Key* key = find_key(generic_path(path));
  if (key == nullptr) reject_unknown_override(document, path, source);
  require_tables(document, path, source);
  const toml::table parsed = parse_override_value(option.substr(equals + 1));
  document.values[path] =
      Given{checked_value(*key, *parsed.get("value"), source, path), source, true};
}

}  // namespace

int Document::count(const std::string& array) const {
  int count = 0;
  while (tables.contains(fmt::format("{}[{}]", array, count))) ++count;
  return count;
}

Document parse_document(std::string_view text, const std::string& name,
                        const std::filesystem::path& folder,
                        std::span<const std::string> overrides) {
  Document document{.name = name, .folder = folder, .values = {}, .tables = {}, .added_tables = {}};
  Flattener(document).table(parse_toml(text, name), "");
  for (const std::string& option : overrides) apply_override(document, option);
  return document;
}

}  // namespace meniscus::schema
