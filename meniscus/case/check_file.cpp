#include "meniscus/case/check_file.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"

namespace meniscus {
namespace {

/// Reads one table of the file and reports its faults.
class Reader {
 public:
  Reader(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  template <class... T>
  [[noreturn]] void reject(const toml::node& node, fmt::format_string<T...> what,
                           T&&... arguments) const {
    reject_input("{}:{}: {}", file_, node.source().begin.line,
                 fmt::format(what, std::forward<T>(arguments)...));
  }

  void allow(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_)
      if (std::ranges::find(keys, key.str()) == keys.end())
        reject(node, "{}: not a key here; allowed are {}", key.str(), fmt::join(keys, ", "));
  }

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

  /// The tables of an array of tables.
  [[nodiscard]] std::vector<Reader> tables(std::string_view key) const {
    std::vector<Reader> readers;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return readers;
    if (!node->is_array_of_tables()) reject(*node, "{}: write [[{}]]", key, key);
    for (const toml::node& entry : *node->as_array())
      readers.emplace_back(*entry.as_table(), file_);
    return readers;
  }

  [[nodiscard]] const toml::table& table() const { return table_; }

 private:
  const toml::table& table_;
  std::string file_;
};

CheckedQuantity::Measure read_measure(const Reader& reader) {
  using enum CheckedQuantity::Measure;
  const std::string word = reader.text("measure").value_or("curve");
  if (word == "curve") return curve;
  if (word == "largest") return largest;
  if (word == "smallest") return smallest;
  if (word == "last") return last;
  reader.reject(reader.table(), "measure = {}: allowed are curve, largest, smallest, last", word);
}

CheckedQuantity read_quantity(const Reader& reader) {
  CheckedQuantity quantity;
  quantity.column = reader.required_text("column");
  quantity.drop = reader.whole("drop").value_or(0);
  quantity.minus_drop = reader.whole("minus-drop");
  quantity.measure = read_measure(reader);
  quantity.event = reader.whole("event");
  if (quantity.event) quantity.measure = CheckedQuantity::Measure::last;
  quantity.over = reader.text("over").value_or("t");
  quantity.at = reader.list<double>("at", "numbers");
  quantity.against = reader.text("against").value_or("");
  quantity.reference = reader.number("reference");
  quantity.source = reader.text("source").value_or("");
  quantity.tolerance = reader.number("tolerance");
  quantity.is_absolute = reader.flag("absolute");
  const bool is_curve = quantity.measure == CheckedQuantity::Measure::curve;
  if (quantity.reference && quantity.source.empty())
    reader.reject(reader.table(), "reference: a source must say where the number is from");
  if (quantity.reference && !quantity.against.empty())
    reader.reject(reader.table(), "reference and against: only one of them");
  if (quantity.reference && is_curve && quantity.at.size() != 1)
    reader.reject(reader.table(), "reference: a curve needs the one place `at` which it is this");
  if (!quantity.reference && quantity.against.empty() && !is_curve)
    reader.reject(reader.table(), "measure: needs a reference number or a run to compare with");
  return quantity;
}

CheckedRun read_run(const Reader& reader) {
  reader.allow({"name", "set", "short", "once", "most-correction", "quantity"});
  CheckedRun run;
  run.name = reader.required_text("name");
  run.overrides = reader.list<std::string>("set", "texts");
  run.is_short = reader.flag("short");
  run.is_once = reader.flag("once");
  run.most_correction = reader.number("most-correction").value_or(run.most_correction);
  if (!(run.most_correction > 0.0))
    reader.reject(reader.table(), "most-correction: must be positive");
  if (run.is_short && run.is_once)
    reader.reject(reader.table(), "short and once: only one of them");
  for (const Reader& entry : reader.tables("quantity")) {
    entry.allow({"column", "event", "drop", "minus-drop", "measure", "over", "at", "against",
                 "reference", "source", "tolerance", "absolute"});
    run.quantities.push_back(read_quantity(entry));
  }
  return run;
}

CheckedExtrapolation read_extrapolation(const Reader& reader) {
  reader.allow({"name", "runs", "nodes", "order", "column", "event", "drop", "minus-drop",
                "measure", "over", "at", "against", "reference", "source", "tolerance",
                "absolute"});
  CheckedExtrapolation result;
  result.name = reader.required_text("name");
  result.runs = reader.list<std::string>("runs", "names of runs");
  result.nodes = reader.list<double>("nodes", "numbers");
  result.order = reader.number("order").value_or(1.0);
  result.quantity = read_quantity(reader);
  if (result.runs.size() < 2 || result.runs.size() != result.nodes.size())
    reader.reject(reader.table(), "runs and nodes: two or more, one N0 for each run");
  if (result.quantity.measure == CheckedQuantity::Measure::curve && result.quantity.at.size() != 1)
    reader.reject(reader.table(), "at: the one place of the curve is wanted");
  return result;
}

/// Throws InvalidInput when a quantity or extrapolation names a run that the file does not have.
void require_known_names(const CheckFile& check, const std::string& file) {
  const auto is_run = [&](const std::string& name) {
    return std::ranges::find(check.runs, name, &CheckedRun::name) != check.runs.end();
  };
  const auto is_known = [&](const std::string& name) {
    return name.empty() || is_run(name) ||
           std::ranges::find(check.extrapolations, name, &CheckedExtrapolation::name) !=
               check.extrapolations.end();
  };
  for (const CheckedRun& run : check.runs)
    for (const CheckedQuantity& quantity : run.quantities)
      if (!is_known(quantity.against))
        reject_input("{}: run \"{}\": against = \"{}\" is no run of this file", file, run.name,
                     quantity.against);
  for (const CheckedExtrapolation& entry : check.extrapolations) {
    for (const std::string& name : entry.runs)
      if (!is_run(name))
        reject_input("{}: extrapolation \"{}\": \"{}\" is no run of this file", file, entry.name,
                     name);
    if (!is_known(entry.quantity.against))
      reject_input("{}: extrapolation \"{}\": against = \"{}\" is no run of this file", file,
                   entry.name, entry.quantity.against);
  }
}

}  // namespace

CheckFile read_check_file(const std::filesystem::path& file) {
  const std::string name = file.string(), text = io::read_file(file);
  toml::table document;
  try {
    document = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    reject_input("{}:{}: {}", name, error.source().begin.line, error.description());
  }
  const Reader reader(document, name);
  reader.allow({"run", "extrapolation"});
  CheckFile check;
  for (const Reader& entry : reader.tables("run")) check.runs.push_back(read_run(entry));
  for (const Reader& entry : reader.tables("extrapolation"))
    check.extrapolations.push_back(read_extrapolation(entry));
  if (check.runs.empty()) reject_input("{}: no [[run]]", name);
  require_known_names(check, name);
  return check;
}

}  // namespace meniscus
