#include "meniscus/case/study_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "meniscus/case/table_reader.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

/// More runs than this are a mistake: a thousand take days.
constexpr std::size_t kMostPoints = 10000;
/// [bracket over value] The least tolerance; values have six digits.
constexpr double kLeastTolerance = 1e-4;

bool read_spacing(const TableReader& reader) {
  const std::string word = reader.text("spacing").value_or("linear");
  if (word != "linear" && word != "log")
    reader.reject(*reader.table().get("spacing"), "spacing = \"{}\": allowed are linear, log",
                  word);
  return word == "log";
}

/// A number that must be there.
double required_number(const TableReader& reader, std::string_view key) {
  const std::optional<double> value = reader.number(key);
  if (!value) reader.reject(reader.table(), "{}: is missing", key);
  if (!std::isfinite(*value)) reader.reject(*reader.table().get(key), "{}: must be finite", key);
  return *value;
}

void require_log_ends(const TableReader& reader, double from, double to) {
  if (!(from * to > 0.0))
    reader.reject(reader.table(),
                  "spacing = \"log\": from = {} and to = {} must have one sign and not be 0", from,
                  to);
}

/// Evenly spaced numbers, or such with a common ratio.
std::vector<std::string> range_values(const TableReader& reader, bool is_logarithmic) {
  const double from = required_number(reader, "from"), to = required_number(reader, "to");
  const std::optional<int> count = reader.whole("count");
  if (!count)
    reader.reject(reader.table(), "count: is missing: how many values from {} to {}", from, to);
  if (*count < 2 || static_cast<std::size_t>(*count) > kMostPoints)
    reader.reject(*reader.table().get("count"), "count = {}: must be between 2 and {}", *count,
                  kMostPoints);
  if (from == to) reader.reject(reader.table(), "from and to are both {}", from);
  if (is_logarithmic) require_log_ends(reader, from, to);
  std::vector<std::string> values;
  for (int i = 0; i < *count; ++i) {
    const double share = static_cast<double>(i) / (*count - 1);
    const double value =
        is_logarithmic ? from * std::pow(to / from, share) : from + share * (to - from);
    values.push_back(fmt::format("{}", rounded(i == 0 ? from : i + 1 == *count ? to : value)));
  }
  return values;
}

std::vector<std::string> listed_values(const TableReader& reader) {
  const toml::node& node = *reader.table().get("values");
  const toml::array* list = node.as_array();
  if (list == nullptr) reader.reject(node, "values: a list is wanted, as in [0.1, 1, 10]");
  if (list->empty()) reader.reject(node, "values: is empty; an axis needs a value or more");
  std::vector<std::string> values;
  for (const toml::node& entry : *list) {
    std::string text = toml_text(entry);
    if (std::ranges::find(values, text) != values.end())
      reader.reject(entry, "values: {} is there twice", text);
    values.push_back(std::move(text));
  }
  return values;
}

StudyAxis read_axis(const TableReader& reader) {
  reader.allow({"key", "values", "from", "to", "count", "spacing"});
  StudyAxis axis{.key = reader.required_text("key"), .values = {}, .source = reader.source("key")};
  axis.is_logarithmic = read_spacing(reader);
  const bool is_list = reader.table().contains("values");
  for (const char* key : {"from", "to", "count", "spacing"})
    if (is_list && reader.table().contains(key))
      reader.reject(*reader.table().get(key), "{}: has no effect beside values", key);
  if (!is_list && !reader.table().contains("from"))
    reader.reject(reader.table(), "an axis needs values = [...], or from, to and count");
  axis.values = is_list ? listed_values(reader) : range_values(reader, axis.is_logarithmic);
  return axis;
}

StudyBisection read_bisection(const TableReader& reader) {
  reader.allow({"key", "from", "to", "tolerance", "spacing", "prolongations"});
  StudyBisection bisection;
  bisection.key = reader.required_text("key");
  bisection.from = required_number(reader, "from");
  bisection.to = required_number(reader, "to");
  bisection.tolerance = reader.number("tolerance").value_or(bisection.tolerance);
  bisection.is_logarithmic = read_spacing(reader);
  bisection.prolongations = reader.whole("prolongations").value_or(bisection.prolongations);
  bisection.source = reader.source("key");
  if (bisection.from == bisection.to)
    reader.reject(reader.table(), "from and to are both {}: nothing lies between", bisection.from);
  if (bisection.is_logarithmic) require_log_ends(reader, bisection.from, bisection.to);
  if (!(bisection.tolerance >= kLeastTolerance && bisection.tolerance < 1.0))
    reader.reject(reader.table(), "tolerance = {}: must be between {} and 1, 1 excluded",
                  bisection.tolerance, kLeastTolerance);
  if (bisection.prolongations < 0 || bisection.prolongations > 10)
    reader.reject(reader.table(), "prolongations = {}: must be between 0 and 10",
                  bisection.prolongations);
  return bisection;
}

void require_distinct_keys(const StudyFile& study) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& key, const std::string& source) {
    if (std::ranges::find(keys, key) != keys.end())
      reject_input("{}: key = \"{}\": has an axis already", source, key);
    keys.push_back(key);
  };
  for (const StudyAxis& axis : study.axes) add(axis.key, axis.source);
  if (study.bisection) add(study.bisection->key, study.bisection->source);
}

std::optional<TableReader> subtable(const TableReader& reader, std::string_view key) {
  const toml::node* node = reader.table().get(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) reader.reject(*node, "{}: write [{}]", key, key);
  return TableReader(*node->as_table(), reader.file());
}

}  // namespace

double rounded(double value) { return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr); }

StudyFile read_study_file(const fs::path& file) {
  const toml::table document = parse_toml_file(file);
  const TableReader reader(document, file.string());
  reader.allow({"study", "axis", "bisection"});
  const std::optional<TableReader> head = subtable(reader, "study");
  if (!head)
    reject_input("{}: [study] is missing; it names the case: case = \"case.toml\"", file.string());
  head->allow({"title", "case", "set"});
  StudyFile study;
  study.name = file.string();
  study.title = head->text("title").value_or("");
  study.case_file = file.parent_path() / head->required_text("case");
  if (!fs::exists(study.case_file))
    head->reject(*head->table().get("case"), "case = \"{}\": there is no file {}",
                 head->required_text("case"), study.case_file.string());
  study.overrides = head->list<std::string>("set", "texts \"key=value\"");
  for (const TableReader& axis : reader.tables("axis")) study.axes.push_back(read_axis(axis));
  if (const auto bisection = subtable(reader, "bisection"))
    study.bisection = read_bisection(*bisection);
  if (study.axes.empty() && !study.bisection)
    reject_input("{}: neither an [[axis]] nor a [bisection]: nothing is varied", file.string());
  require_distinct_keys(study);
  std::size_t count = 1;
  for (const StudyAxis& axis : study.axes)
    count = std::min(count * axis.values.size(), kMostPoints + 1);
  if (count > kMostPoints)
    reject_input("{}: the axes have more than {} points together", file.string(), kMostPoints);
  return study;
}

std::vector<StudyPoint> points_of(const StudyFile& study) {
  std::vector<StudyPoint> points{{}};
  for (const StudyAxis& axis : study.axes) {
    std::vector<StudyPoint> longer;
    for (const StudyPoint& point : points)
      for (const std::string& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    points = std::move(longer);
  }
  return points;
}

std::vector<std::string> overrides_at(const StudyFile& study, const StudyPoint& point,
                                      std::optional<double> value) {
  std::vector<std::string> overrides = study.overrides;
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    overrides.push_back(fmt::format("{}={}", study.axes[i].key, point[i]));
  if (study.bisection && value)
    overrides.push_back(fmt::format("{}={}", study.bisection->key, *value));
  return overrides;
}

Case case_at(const StudyFile& study, const StudyPoint& point, std::optional<double> value) {
  const std::vector<std::string> overrides = overrides_at(study, point, value);
  try {
    return read_case(study.case_file, overrides);
  } catch (const InvalidInput& fault) {
    const std::string text = fault.what();
    const auto is_about = [&](std::size_t k) {
      return text.starts_with("--set " + overrides[k] + ":");
    };
    for (std::size_t k = 0; k < overrides.size(); ++k) {
      if (!is_about(k)) continue;
      const std::string said = text.substr(std::string("--set ").size());
      const std::size_t axis = k - study.overrides.size();
      if (k < study.overrides.size()) reject_input("{}: set: {}", study.name, said);
      reject_input("{}: {}",
                   axis < study.axes.size() ? study.axes[axis].source : study.bisection->source,
                   said);
    }
    throw;
  }
}

void require_valid_cases(const StudyFile& study) {
  for (const StudyPoint& point : points_of(study)) {
    if (!study.bisection) {
      (void)case_at(study, point);
      continue;
    }
    for (const double end : {study.bisection->from, study.bisection->to}) {
      const StopRules stop = case_at(study, point, end).stop;
      if (!stop.steady_rate || !(stop.is_broken_by_event || stop.broken_length))
        reject_input(
            "{}: a bisection needs time.stop-when.steady-rate, and time.stop-when.broken or "
            "broken-length, in {} or by set",
            study.bisection->source, study.case_file.string());
    }
  }
}

}  // namespace meniscus
