#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/comparison.hpp"
#include "meniscus/report/page.hpp"
#include "meniscus/report/page_data.hpp"
#include "meniscus/report/report.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

constexpr std::size_t most_runs = 8;  // a browser can hold no more 3-D views

/// The last `count` parts of a path.
fs::path last_parts(const fs::path& path, std::ptrdiff_t count) {
  const fs::path parts = path.relative_path();
  const std::ptrdiff_t all = std::distance(parts.begin(), parts.end());
  fs::path last;
  for (auto part = std::next(parts.begin(), std::max<std::ptrdiff_t>(0, all - count));
       part != parts.end(); ++part)
    last /= *part;
  return last;
}

/// The names of the folders, each with enough of its path to be unique.
std::vector<std::string> names_of(std::span<const fs::path> folders) {
  std::vector<fs::path> paths;
  for (const fs::path& folder : folders)
    paths.push_back(fs::absolute(folder / ".").lexically_normal().parent_path());
  std::vector<std::string> names;
  for (const fs::path& path : paths) {
    std::ptrdiff_t count = 1;
    const auto is_alike = [&](const fs::path& other) {
      return other != path && last_parts(other, count) == last_parts(path, count);
    };
    while (std::ranges::any_of(paths, is_alike)) ++count;
    names.push_back(last_parts(path, count).string());
  }
  return names;
}

std::string facts_row(const char* label, std::span<const RunData> runs,
                      const std::function<std::string(const RunData&)>& value) {
  std::string cells;
  bool is_empty = true;
  for (const RunData& run : runs) {
    const std::string text = value(run);
    is_empty &= text.empty();
    cells += fmt::format("<td>{}</td>", markup_text(text));
  }
  return is_empty ? "" : fmt::format("<tr><th>{}</th>{}</tr>\n", label, cells);
}

/// A table of the runs side by side, with the case keys in which they differ.
std::string runs_html(std::span<const RunData> runs, std::span<const std::string> names) {
  std::string head, rows;
  for (const std::string& name : names) head += fmt::format("<th>{}</th>", markup_text(name));
  rows += facts_row("Title", runs, [](const RunData& run) { return run.facts.title; });
  rows += facts_row("Status", runs, [](const RunData& run) { return run.facts.status; });
  rows += facts_row("Version", runs, [](const RunData& run) {
    return run.facts.version + (run.facts.commit.empty() ? "" : " (" + run.facts.commit + ")");
  });
  rows += facts_row("Steps", runs, [](const RunData& run) { return run.facts.steps; });
  rows += facts_row("Time reached", runs, [](const RunData& run) { return run.facts.t; });
  rows += facts_row("Wall time", runs, [](const RunData& run) {
    return run.facts.wall_seconds > 0.0 ? duration_text(run.facts.wall_seconds) : "";
  });
  std::map<std::string, bool> seen;
  for (const RunData& run : runs) {
    for (const auto& [key, ignored] : run.facts.case_values) {
      if (std::exchange(seen[key], true)) continue;
      const auto value = [&key = key](const RunData& r) { return r.facts.case_value(key); };
      const bool is_same = std::ranges::all_of(
          runs, [&](const RunData& r) { return value(r) == value(runs.front()); });
      if (!is_same) rows += facts_row(markup_text(key).c_str(), runs, value);
    }
  }
  return fmt::format(
      "<div class=\"card scroll\"><table class=\"runs\"><caption>The runs, and where their cases "
      "differ</caption><thead><tr><th></th>{}</tr></thead><tbody>{}</tbody></table></div>\n",
      head, rows);
}

/// The table of differences between a run and the first run.
std::string differences_html(const RunData& first, const RunData& run,
                             const std::string& first_name, const std::string& name, double end) {
  std::string rows;
  for (const Difference& d : differences(first, run, end)) {
    const std::string label = fmt::format("{} of drop {}", markup_text(d.quantity), d.drop);
    rows += fmt::format(
        "<tr><th>{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
        label, number_text(d.first_at_end, 6), number_text(d.at_end, 6),
        number_text(d.at_end - d.first_at_end, 3), number_text(d.largest, 3),
        number_text(d.t_of_largest, 4));
  }
  if (rows.empty()) return {};
  return fmt::format(
      "<div class=\"card scroll\"><table class=\"differences\"><caption>{1} against {0}</caption>"
      "<thead><tr><th></th><th class=\"n\">{0}, t = {2}</th><th class=\"n\">{1}, t = {2}</th>"
      "<th class=\"n\">difference there</th><th class=\"n\">largest |difference|</th>"
      "<th class=\"n\">at t</th></tr></thead><tbody>{3}</tbody></table></div>\n",
      markup_text(first_name), markup_text(name), number_text(end, 4), rows);
}

std::string faults_html(std::span<const RunData> runs, std::span<const std::string> names) {
  std::string text;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const std::string& fault : runs[r].faults)
      text += fmt::format("<p>{}: {}</p>", markup_text(names[r]), markup_text(fault));
  }
  return text.empty() ? "" : "<div class=\"notice\">" + text + "</div>\n";
}

}  // namespace

void write_comparison(std::span<const fs::path> run_directories, const fs::path& out) {
  if (run_directories.size() < 2 || run_directories.size() > most_runs) {
    reject_input("{} runs were given to compare; from 2 to {} can be", run_directories.size(),
                 most_runs);
  }
  const std::vector<std::string> names = names_of(run_directories);
  std::vector<RunData> runs;
  for (const fs::path& folder : run_directories) runs.push_back(load_run(folder));
  const double end = common_end(runs);

  PageParts parts{.title = fmt::format("{}", fmt::join(names, ", ")), .content = {}, .data = {}};
  const auto num_quiescent =
      std::ranges::count_if(runs, [](const RunData& run) { return run.facts.is_quiescent(); });
  if (num_quiescent > 0)
    parts.units = std::cmp_less(num_quiescent, runs.size()) ? PageUnits::both : PageUnits::at_rest;
  PageBudget budget;
  budget.frames /= runs.size();
  budget.cuts = 0;
  budget.most_cuts = 0;
  std::vector<PageRun> pages;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    pages.push_back(page_run(runs[r], budget));
    pages.back().name = names[r];
  }
  parts.data = data_elements(drawing_data("comparison", runs, pages, budget));
  std::string tables = runs_html(runs, names);
  for (std::size_t r = 1; r < runs.size(); ++r)
    tables += differences_html(runs.front(), runs[r], names.front(), names[r], end);
  parts.content =
      fmt::format("<header><h1>{} runs compared</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n",
                  runs.size(), markup_text(parts.title), faults_html(runs, names)) +
      "<div id=\"app\"></div>\n<h2>Differences</h2>\n" + tables;
  io::write_file(out, whole_page(parts));
}

}  // namespace meniscus
