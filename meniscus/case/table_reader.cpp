#include "meniscus/case/table_reader.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/ranges.h>

#include "meniscus/case/nearest_word.hpp"
#include "meniscus/case/value.hpp"
#include "meniscus/io/atomic_file.hpp"

namespace meniscus {

toml::table parse_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    std::string description(error.description());
    std::ranges::replace(description, '\n', ' ');
    reject_input("{}:{}: not valid TOML: {}", name, error.source().begin.line, description);
  }
}

toml::table parse_toml_file(const std::filesystem::path& file) {
  return parse_toml(io::read_file(file), file.string());
}

std::string toml_text(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    std::string text = "[";
    for (const toml::node& element : *array)
      text += (text.size() > 1 ? ", " : "") + toml_text(element);
    return text + "]";
  }
  if (node.is_table()) return "a table";
  if (const auto text = node.value_exact<std::string>()) return schema::to_toml(*text);
  if (const auto real = node.value_exact<double>()) return schema::to_toml(*real);
  std::ostringstream stream;
  node.visit([&](const auto& value) { stream << value; });
  return stream.str();
}

void TableReader::allow(std::initializer_list<std::string_view> keys) const {
  for (const auto& [key, node] : table_) {
    if (std::ranges::find(keys, key.str()) != keys.end()) continue;
    const std::string_view near = nearest_word(key.str(), keys);
    reject(node, "{}: not a key here{}; allowed are {}", key.str(),
           near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near), fmt::join(keys, ", "));
  }
}

}  // namespace meniscus
