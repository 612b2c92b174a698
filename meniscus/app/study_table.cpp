// The table and the page of a study, from the results of its runs.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/app/study.hpp"
#include "meniscus/core/version.hpp"
#include "meniscus/io/csv_line.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/io/table.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus {
namespace {

using io::Cell;
using Cells = std::vector<Cell>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class T>
Cell cell(const std::optional<T>& value) {
  return value ? Cell(*value) : Cell();
}

/// What a run came to, by column.
struct ResultColumn {
  const char *name, *unit;
  Cell (*value)(const StudyRunResult&);
};
constexpr std::array<ResultColumn, 10> kResultColumns{{
    {"ended", "", [](const StudyRunResult& r) { return Cell(r.ended); }},
    {"t", "1/G", [](const StudyRunResult& r) { return Cell(r.t); }},
    {"steps", "", [](const StudyRunResult& r) { return Cell(r.steps); }},
    {"events", "", [](const StudyRunResult& r) { return Cell(std::int64_t(r.events)); }},
    {"drops", "", [](const StudyRunResult& r) { return Cell(std::int64_t(r.drops)); }},
    {"volumes", "R0³",
     [](const StudyRunResult& r) { return Cell(fmt::format("{}", fmt::join(r.volumes, ";"))); }},
    {"L", "R0", [](const StudyRunResult& r) { return Cell(r.L); }},
    {"B", "R0", [](const StudyRunResult& r) { return Cell(r.B); }},
    {"D", "", [](const StudyRunResult& r) { return Cell(r.D); }},
    {"angle_deg", "degrees", [](const StudyRunResult& r) { return cell(r.angle_deg); }},
}};

/// The run of a point that its row is about: the steady end of a bracket, else the broken one.
struct RowRun {
  std::optional<double> value;
  const StudyRunResult* result = nullptr;
};
RowRun row_run(const StudyPointResult& point) {
  if (!point.bracket) return {std::nullopt, &point.runs.begin()->second};
  const auto value = point.bracket->steady() ? point.bracket->steady() : point.bracket->broken();
  if (!value) return {};
  return {value, &point.runs.at(*value)};
}

bool is_complete(const StudyPointResult& point) {
  return point.bracket ? point.bracket->result() != Bracket::Result::open : !point.runs.empty();
}

/// Why a point has no result, with the value where there is one.
std::string reason_of(const StudyPointResult& point) {
  for (const auto& [value, result] : point.runs) {
    const std::string at = point.bracket ? fmt::format("at {}: ", value) : "";
    if (!result.failure.empty()) return at + result.failure;
  }
  if (!point.bracket) return {};
  for (const auto& [value, result] : point.runs)
    if (result.verdict() == Verdict::undecided)
      return fmt::format("at {}: undecided at t = {:.6g}{}", value, result.t,
                         result.ended == "time" ? "" : ", ended by " + result.ended);
  const Bracket::Result outcome = point.bracket->result();
  if (outcome == Bracket::Result::all_steady || outcome == Bracket::Result::all_broken)
    return fmt::format("no critical value between {} and {}", point.runs.begin()->first,
                       point.runs.rbegin()->first);
  return {};
}

std::vector<std::string> column_names(const StudyFile& study) {
  std::vector<std::string> names;
  for (const StudyAxis& axis : study.axes) names.push_back(axis.key);
  names.emplace_back("outcome");
  if (study.bisection)
    for (const std::string& of :
         {std::string("critical"), std::string("steady"), std::string("broken")})
      names.push_back(fmt::format("{} {}", of, study.bisection->key));
  if (study.bisection) names.insert(names.end(), {"width", "runs"});
  for (const ResultColumn& column : kResultColumns) names.emplace_back(column.name);
  names.emplace_back("why");
  return names;
}

/// The value of an axis as a cell: a text without its quotes.
std::string plain(const std::string& toml) {
  const bool is_quoted = toml.size() > 1 && toml.front() == '"' && toml.back() == '"';
  return is_quoted ? toml.substr(1, toml.size() - 2) : toml;
}

Cells row_of(const Study& study, std::size_t i) {
  const StudyPointResult& point = study.results()[i];
  const RowRun run = row_run(point);
  Cells row;
  for (const std::string& value : study.folders().points()[i]) row.emplace_back(plain(value));
  if (point.bracket) {
    row.emplace_back(word_for(point.bracket->result()));
    row.push_back(cell(point.bracket->middle()));
    row.push_back(cell(point.bracket->steady()));
    row.push_back(cell(point.bracket->broken()));
    row.push_back(cell(point.bracket->relative_width()));
    row.emplace_back(std::int64_t(point.runs.size()));
  } else {
    row.emplace_back(run.result->failure.empty() ? "done" : "failed");
  }
  const bool has_result = run.result != nullptr && run.result->failure.empty();
  for (const ResultColumn& column : kResultColumns)
    row.push_back(has_result ? column.value(*run.result) : Cell());
  row.emplace_back(reason_of(point));
  return row;
}

/// "viscosity-ratio = 0.5, nodes = 60", without the axis `left_out`.
std::string label_of(const Study& study, std::size_t point, std::optional<std::size_t> left_out) {
  std::vector<std::string> parts;
  const StudyFile& file = study.folders().study();
  for (std::size_t k = 0; k < file.axes.size(); ++k)
    if (k != left_out)
      parts.push_back(fmt::format("{} = {}", schema::leaf(file.axes[k].key),
                                  plain(study.folders().points()[point][k])));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// What a bisection came to: "critical capillary-number 0.41445: steady at 0.4107, broken at
/// 0.4182".
std::string outcome_of(const StudyPointResult& point, const std::string& key) {
  const Bracket& bracket = *point.bracket;
  if (bracket.result() != Bracket::Result::critical)
    return fmt::format("{}: {}", word_for(bracket.result()), reason_of(point));
  return fmt::format("critical {} {:.5g}: steady at {}, broken at {}", schema::leaf(key),
                     *bracket.middle(), *bracket.steady(), *bracket.broken());
}

std::string line_of(const Study& study, std::size_t point) {
  const std::string label = label_of(study, point, std::nullopt);
  return fmt::format("{}{}{}", label, label.empty() ? "" : ": ",
                     outcome_of(study.results()[point], study.folders().study().bisection->key));
}

std::string head_of(const Study& study) {
  const StudyFile& file = study.folders().study();
  std::string key;
  for (const ResultColumn& column : kResultColumns)
    if (*column.unit != '\0')
      key += fmt::format("{}{} in {}", key.empty() ? "" : ", ", column.name, column.unit);
  std::string text =
      fmt::format("# {}\n# meniscus {} ({}); {}\n", file.title.empty() ? file.name : file.title,
                  version_string, commit_string, key);
  return text;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The axis that plots are against: the first whose values are numbers, two or more.
std::optional<std::size_t> plotted_axis(const StudyFile& study) {
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    if (study.axes[i].values.size() > 1 &&
        std::ranges::all_of(study.axes[i].values,
                            [](const auto& v) { return number(v).has_value(); }))
      return i;
  return std::nullopt;
}

/// A quantity of a point that is plotted.
struct PlottedQuantity {
  const char *title, *unit;
  double (*value)(const StudyPointResult&);
};
double of_row_run(const StudyPointResult& point, double (*value)(const StudyRunResult&)) {
  const RowRun run = row_run(point);
  return run.result != nullptr && run.result->failure.empty() ? value(*run.result) : kNone;
}
constexpr std::array<PlottedQuantity, 5> kPlotted{{
    {"Half-length L at the end", "R0",
     [](const StudyPointResult& p) {
       return of_row_run(p, [](const StudyRunResult& r) { return r.L; });
     }},
    {"Deformation D at the end", "",
     [](const StudyPointResult& p) {
       return of_row_run(p, [](const StudyRunResult& r) { return r.D; });
     }},
    {"Inclination at the end", "°",
     [](const StudyPointResult& p) {
       return of_row_run(p, [](const StudyRunResult& r) { return r.angle_deg.value_or(kNone); });
     }},
    {"Drops at the end", "",
     [](const StudyPointResult& p) {
       return of_row_run(p, [](const StudyRunResult& r) { return double(r.drops); });
     }},
    {"Time at the end", "1/G",
     [](const StudyPointResult& p) {
       return of_row_run(p, [](const StudyRunResult& r) { return r.t; });
     }},
}};

/// One curve for each choice of values of the other axes.
class PointCurves {
 public:
  PointCurves(const Study& study, std::size_t axis) : study_(study), axis_(axis) {
    const StudyFile& file = study.folders().study();
    is_log_ = file.axes[axis].is_logarithmic;
    x_label_ = is_log_ ? fmt::format("log₁₀ {}", file.axes[axis].key) : file.axes[axis].key;
    for (std::size_t i = 0; i < study.results().size(); ++i) {
      const std::string label = label_of(study, i, axis);
      auto group = std::ranges::find(groups_, label, &Group::label);
      if (group == groups_.end()) group = groups_.insert(groups_.end(), {label, {}});
      group->points.push_back(i);
    }
  }

  template <class Value>
  void add(report::Plot& plot, const Value& value, const std::string& name, int dash) const {
    int color = 0;
    for (const Group& group : groups_) {
      report::Curve curve{.color = color++, .dash = dash};
      curve.label = group.label.empty() || name.empty() ? group.label + name
                                                        : fmt::format("{}, {}", group.label, name);
      std::vector<std::pair<double, double>> points;
      for (const std::size_t i : group.points)
        points.emplace_back(x_of(i),
                            is_complete(study_.results()[i]) ? value(study_.results()[i]) : kNone);
      std::ranges::sort(points, {}, &std::pair<double, double>::first);
      for (const auto& [x, y] : points) {
        curve.x.push_back(x);
        curve.y.push_back(y);
      }
      const bool is_empty =
          std::ranges::none_of(curve.y, [](double y) { return std::isfinite(y); });
      if (!is_empty) plot.curves.push_back(std::move(curve));
    }
  }
  [[nodiscard]] const std::string& x_label() const { return x_label_; }

 private:
  struct Group {
    std::string label;
    std::vector<std::size_t> points;
  };
  [[nodiscard]] double x_of(std::size_t i) const {
    const double x = *number(study_.folders().points()[i][axis_]);
    return is_log_ ? std::log10(x) : x;
  }

  const Study& study_;
  std::size_t axis_;
  bool is_log_ = false;
  std::string x_label_;
  std::vector<Group> groups_;
};

std::vector<report::Plot> plots_of(const Study& study) {
  const StudyFile& file = study.folders().study();
  const std::optional<std::size_t> axis = plotted_axis(file);
  if (!axis) return {};
  const PointCurves curves(study, *axis);
  std::vector<report::Plot> plots;
  if (file.bisection) {
    report::Plot plot{.title = "Critical " + file.bisection->key, .x_label = curves.x_label()};
    plot.is_log = file.bisection->is_logarithmic;
    curves.add(
        plot, [](const StudyPointResult& p) { return p.bracket->steady().value_or(kNone); },
        "steady", 0);
    curves.add(
        plot, [](const StudyPointResult& p) { return p.bracket->broken().value_or(kNone); },
        "broken", 1);
    plots.push_back(std::move(plot));
  }
  for (const PlottedQuantity& quantity : kPlotted) {
    report::Plot plot{.title = quantity.title, .unit = quantity.unit, .x_label = curves.x_label()};
    if (file.bisection) plot.title += " (steady end of the bracket)";
    curves.add(plot, quantity.value, "", 0);
    if (!plot.curves.empty()) plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<report::StudyPageRun> runs_of(const Study& study) {
  std::vector<report::StudyPageRun> runs;
  const StudyFolders& folders = study.folders();
  for (std::size_t i = 0; i < study.results().size(); ++i) {
    const StudyPointResult& point = study.results()[i];
    for (const auto& [value, result] : point.runs) {
      const StudyRun run = folders.run_at(i, point.bracket ? std::optional(value) : std::nullopt);
      report::StudyPageRun shown{.name = run.name, .folder = folders.folder(run)};
      if (std::filesystem::exists(shown.folder / io::RunFiles::page))
        shown.link = fmt::format("runs/{}/{}", run.name, io::RunFiles::page);
      shown.outcome = !result.failure.empty() ? "failed: " + result.failure
                      : point.bracket         ? word_for(result.verdict())
                                              : result.ended;
      shown.is_shown =
          result.failure.empty() &&
          (!point.bracket || point.bracket->steady() == value || point.bracket->broken() == value);
      runs.push_back(std::move(shown));
    }
  }
  return runs;
}

/// A cell for readers.
struct CellForReaders {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return report::number_text(value, 5); }
  std::string operator()(const std::string& value) const { return value; }
};

}  // namespace

std::string study_table(const Study& study) {
  const std::vector<std::string> names = column_names(study.folders().study());
  std::string text = head_of(study) + io::csv_line(Cells(names.begin(), names.end()));
  for (std::size_t i = 0; i < study.results().size(); ++i)
    if (is_complete(study.results()[i])) text += io::csv_line(row_of(study, i));
  return text;
}

std::vector<std::string> study_outcomes(const Study& study) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < study.results().size(); ++i)
    if (const StudyPointResult& point = study.results()[i]; point.bracket && is_complete(point))
      lines.push_back(line_of(study, i));
  return lines;
}

report::StudyPage study_page(const Study& study) {
  const StudyFile& file = study.folders().study();
  report::StudyPage page;
  page.title = file.title.empty() ? file.name : file.title;
  page.columns = column_names(file);
  std::size_t complete = 0;
  for (std::size_t i = 0; i < study.results().size(); ++i) {
    if (!is_complete(study.results()[i])) continue;
    ++complete;
    std::vector<std::string> cells;
    for (const Cell& each : row_of(study, i)) cells.push_back(std::visit(CellForReaders{}, each));
    page.rows.push_back(std::move(cells));
  }
  page.runs = runs_of(study);
  page.lead =
      fmt::format("{} of {} points, {} runs, {} failed; case {}", complete, study.results().size(),
                  page.runs.size(), study.num_failed(), file.case_file.string());
  page.plots = plots_of(study);
  return page;
}

}  // namespace meniscus
