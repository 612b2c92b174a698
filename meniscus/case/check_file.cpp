#include "meniscus/case/check_file.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "meniscus/case/table_reader.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

CheckedQuantity::Measure read_measure(const TableReader& reader) {
  using enum CheckedQuantity::Measure;
  const std::string word = reader.text("measure").value_or("curve");
  if (word == "curve") return curve;
  if (word == "largest") return largest;
  if (word == "smallest") return smallest;
  if (word == "last") return last;
  reader.reject(reader.table(), "measure = {}: allowed are curve, largest, smallest, last", word);
}

CheckedQuantity read_quantity(const TableReader& reader) {
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
  quantity.is_magnitude = reader.flag("magnitude");
  quantity.is_of_all_drops = reader.flag("all-drops");
  const bool is_curve = quantity.measure == CheckedQuantity::Measure::curve;
  if (quantity.is_of_all_drops && quantity.measure != CheckedQuantity::Measure::largest &&
      quantity.measure != CheckedQuantity::Measure::smallest)
    reader.reject(reader.table(), "all-drops: only for the measures largest and smallest");
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

CheckedRun read_run(const TableReader& reader) {
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
  for (const TableReader& entry : reader.tables("quantity")) {
    entry.allow({"column", "event", "drop", "minus-drop", "measure", "over", "at", "against",
                 "reference", "source", "tolerance", "absolute", "magnitude", "all-drops"});
    run.quantities.push_back(read_quantity(entry));
  }
  return run;
}

CheckedExtrapolation read_extrapolation(const TableReader& reader) {
  reader.allow({"name", "runs", "nodes", "order", "column", "event", "drop", "minus-drop",
                "measure", "over", "at", "against", "reference", "source", "tolerance", "absolute",
                "magnitude", "all-drops"});
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
  const std::string name = file.string();
  const toml::table document = parse_toml_file(file);
  const TableReader reader(document, name);
  reader.allow({"run", "extrapolation"});
  CheckFile check;
  for (const TableReader& entry : reader.tables("run")) check.runs.push_back(read_run(entry));
  for (const TableReader& entry : reader.tables("extrapolation"))
    check.extrapolations.push_back(read_extrapolation(entry));
  if (check.runs.empty()) reject_input("{}: no [[run]]", name);
  require_known_names(check, name);
  return check;
}

}  // namespace meniscus
