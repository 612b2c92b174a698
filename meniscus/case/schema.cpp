#include "meniscus/case/schema.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "meniscus/case/nearest_word.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus::schema {

const Key* find_key(std::string_view path) {
  const auto found = std::ranges::find(keys(), path, &Key::path);
  return found == keys().end() ? nullptr : &*found;
}

const Table* find_table(std::string_view path) {
  const auto found = std::ranges::find(tables(), path, &Table::path);
  return found == tables().end() ? nullptr : &*found;
}

std::string generic_path(std::string_view path) {
  std::string generic;
  bool in_index = false;
  for (const char c : path) {
    if (c == ']') in_index = false;
    if (!in_index) generic += c;
    if (c == '[') in_index = true;
  }
  return generic;
}

std::string without_indices(std::string_view path) {
  std::string plain = generic_path(path);
  for (std::size_t at = plain.find("[]"); at != std::string::npos; at = plain.find("[]"))
    plain.erase(at, 2);
  return plain;
}

std::string_view parent_path(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

std::string_view leaf(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

std::string_view unit(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "";
    case Dimension::length:
      return "R0";
    case Dimension::time:
      return "1/G";
    case Dimension::rate:
      return "G";
    case Dimension::velocity:
      return "G R0";
    case Dimension::stress:
      return "mu_out G";
    case Dimension::force_density:
      return "mu_out G/R0";
    case Dimension::gravity:
      return "sigma/(rho_out R0²)";
  }
  return "";
}

std::string_view si_unit(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "";
    case Dimension::length:
      return "m";
    case Dimension::time:
      return "s";
    case Dimension::rate:
      return "1/s";
    case Dimension::velocity:
      return "m/s";
    case Dimension::stress:
      return "Pa";
    case Dimension::force_density:
      return "N/m³";
    case Dimension::gravity:
      return "m/s²";
  }
  return "";
}

std::string range_text(const Range& range) {
  const bool bounded_below = std::isfinite(range.min), bounded_above = std::isfinite(range.max);
  std::string text;
  if (bounded_below && bounded_above)
    text = fmt::format("between {} and {}{}", range.min, range.max,
                       range.open_min && range.open_max ? ", both excluded"
                       : range.open_min                 ? fmt::format(", {} excluded", range.min)
                       : range.open_max                 ? fmt::format(", {} excluded", range.max)
                                                        : "");
  else if (bounded_below)
    text = range.open_min ? fmt::format("> {}", range.min) : fmt::format("at least {}", range.min);
  else if (bounded_above)
    text = range.open_max ? fmt::format("< {}", range.max) : fmt::format("at most {}", range.max);
  if (range.infinity) text += text.empty() ? "finite or inf" : " or inf";
  return text;
}

bool is_within(const Range& range, double value) {
  if (std::isnan(value)) return false;
  if (std::isinf(value)) return range.infinity && value > 0.0;
  const bool above = range.open_min ? value > range.min : value >= range.min;
  const bool below = range.open_max ? value < range.max : value <= range.max;
  return above && below;
}

std::string quoted_list(std::span<const std::string_view> words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

namespace {

void check_word(const Key& key, const Value& value, std::string_view source,
                std::string_view name) {
  const std::string& word = std::get<std::string>(value);
  if (std::ranges::find(key.words, word) != key.words.end()) return;
  const std::string_view near = nearest_word(word, key.words);
  reject_input("{}: {} = {} must be one of {}{}", source, name, to_toml(value),
               quoted_list(key.words),
               near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

bool is_finite(const Value& value) {
  return std::ranges::all_of(numbers_in(value), [](double x) { return std::isfinite(x); });
}

}  // namespace

std::string range_complaint(const Key& key, const Value& value) {
  for (const double number : numbers_in(value)) {
    if (is_within(key.range, number)) continue;
    const std::string allowed = range_text(key.range);
    const bool must_be_finite = !std::isfinite(number) && !key.range.infinity;
    return fmt::format("must be {}{}{}", must_be_finite ? "finite" : "",
                       must_be_finite && !allowed.empty() ? " and " : "", allowed);
  }
  return {};
}

void check_value(const Key& key, const Value& value, std::string_view source,
                 std::string_view name) {
  const bool is_word = std::holds_alternative<std::string>(value);
  if (is_word && (key.type == Type::word || key.type == Type::velocity))
    check_word(key, value, source, name);
  if (key.dimension != Dimension::none && is_finite(value)) return;
  if (const std::string complaint = range_complaint(key, value); !complaint.empty())
    reject_input("{}: {} = {} {}", source, name, to_toml(value), complaint);
}

std::string nearest_name(std::string_view path) {
  const std::string generic = generic_path(path);
  std::vector<std::string> plain;  // every key and table as in a case file
  for (const Key& key : keys()) plain.push_back(without_indices(key.path));
  for (const Table& table : tables()) plain.push_back(without_indices(table.path));
  const std::string wanted = without_indices(generic);

  const std::string parent(parent_path(wanted));
  std::vector<std::string_view> siblings, all;
  for (const std::string& name : plain) {
    if (name.empty()) continue;  // the top level
    if (parent_path(name) == parent) siblings.push_back(leaf(name));
    all.push_back(name);
  }
  if (const auto near = nearest_word(leaf(wanted), siblings); !near.empty())
    return parent.empty() ? std::string(near) : fmt::format("{}.{}", parent, near);
  const auto longer = std::ranges::find_if(siblings, [&](std::string_view sibling) {
    return sibling.starts_with(leaf(wanted)) && !leaf(wanted).empty();
  });
  if (longer != siblings.end())
    return parent.empty() ? std::string(*longer) : fmt::format("{}.{}", parent, *longer);
  const auto elsewhere = std::ranges::find(all, leaf(wanted), leaf);
  if (elsewhere != all.end()) return std::string(*elsewhere);  // right key, wrong table
  return std::string(nearest_word(wanted, all));
}

void reject_unknown_key(std::string_view path, std::string_view source) {
  const std::string near = nearest_name(path);
  const bool is_sibling = parent_path(near) == parent_path(without_indices(path));
  reject_input("{}: {}: unknown key{}", source, path,
               near.empty() ? ""
                            : fmt::format("; did you mean \"{}\"?",
                                          is_sibling ? leaf(near) : std::string_view(near)));
}

}  // namespace meniscus::schema
