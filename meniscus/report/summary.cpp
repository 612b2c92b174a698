#include "meniscus/report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "meniscus/report/text.hpp"
#include "meniscus/report/volume_corrections.hpp"

namespace meniscus::report {
namespace {

constexpr int decimals = 4;  // of lengths in a table; more than the accuracy of any mesh
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> column(const std::optional<io::Table>& table, const std::string& name) {
  return table && table->find(name) ? table->column(name) : std::vector<double>();
}

double last(const std::optional<io::Table>& table, const std::string& name) {
  const std::vector<double> values = column(table, name);
  return values.empty() ? nan : values.back();
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = nan;
  for (const double v : values) largest = std::fmax(largest, std::abs(v));
  return largest;
}

/// The last step of drops.csv, whose steps are given, that history.csv has as well: its row is
/// written when those of all drops are. Of a table without such a step the last one.
double last_whole_step(const RunData& run, const std::vector<double>& steps) {
  double step = nan;
  const double end = last(run.history, "step");
  for (const double s : steps)
    if (s <= end) step = std::fmax(step, s);
  return std::isnan(step) ? steps.back() : step;
}

/// "simple-shear" as "Simple shear".
std::string in_words(std::string key) {
  std::ranges::replace(key, '-', ' ');
  if (!key.empty() && key[0] >= 'a' && key[0] <= 'z')
    key[0] = static_cast<char>(key[0] - 'a' + 'A');
  return key;
}

/// The flow and the dimensionless numbers that the case gives.
std::string physics(const RunFacts& facts) {
  std::vector<std::string> parts;
  const auto add_value = [&](const std::string& value, const char* symbol) {
    if (!value.empty()) parts.push_back(fmt::format("<i>{}</i> = {}", symbol, markup_text(value)));
  };
  const auto add = [&](const std::string& key, const char* symbol) {
    add_value(facts.case_value(key), symbol);
  };
  const std::string flow = facts.case_value("flow.kind");
  if (!flow.empty()) parts.push_back(markup_text(in_words(flow)));
  add_value(facts.dimensionless("Ca", "flow.capillary-number"), "Ca");
  if (const std::string Re = facts.dimensionless("Re", "flow.reynolds-number");
      !Re.empty() && Re.find_first_not_of("0.") != std::string::npos)
    add_value(Re, "Re");
  add("drop[0].viscosity-ratio", "λ");
  add("drop[0].nodes", "N₀");
  const bool has_several = !facts.case_value("drop[1].viscosity-ratio").empty();
  if (has_several) parts.emplace_back("λ and N₀ of drop 0");
  return fmt::format("{}", fmt::join(parts, " · "));
}

std::string degrees(double angle) {
  return std::isfinite(angle) ? number_text(angle, 3) + "°" : number_text(angle);
}

struct Tile {
  std::string name, value, unit;
};

std::string row(const std::string& name, const std::string& value) {
  return value.empty() ? ""
                       : fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, markup_text(value));
}

std::string notice(const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string text = "<div class=\"notice\">";
  for (const std::string& line : lines) text += fmt::format("<p>{}</p>", markup_text(line));
  return text + "</div>\n";
}

}  // namespace

std::string heading_html(const RunData& run) {
  const RunFacts& facts = run.facts;
  const std::string title = facts.title.empty() ? run.folder.filename().string() : facts.title;
  const std::string word = facts.status.substr(0, facts.status.find(':'));
  const char* kind = word == "done" ? "done" : word == "failed" ? "failed" : "other";
  const std::string status =
      word.empty() ? ""
                   : fmt::format("<span class=\"status {}\">{}</span>", kind, markup_text(word));
  std::vector<std::string> lines;
  if (word != facts.status) lines.push_back(facts.status);
  lines.insert(lines.end(), facts.warnings.begin(), facts.warnings.end());
  lines.insert(lines.end(), run.faults.begin(), run.faults.end());
  return fmt::format("<header><h1>{}{}</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n",
                     markup_text(title.empty() ? "A run" : title), status, physics(facts),
                     notice(lines));
}

std::string tiles_html(const RunData& run) {
  const double tetrahedra = last(run.history, "tetrahedra"), steps = last(run.history, "step");
  const double drift = largest_magnitude(column(run.drops, "volume_drift"));
  std::vector<Tile> tiles = {{"Time reached", number_text(last(run.history, "t")),
                              run.facts.is_quiescent() ? "μR₀/σ" : "1/G"},
                             {"Steps", count_text(steps), ""}};
  if (last(run.history, "drops") == 1.0) {
    tiles.push_back({"Deformation D", number_text(last(run.drops, "D")), ""});
    tiles.push_back({"Inclination", degrees(last(run.drops, "angle_deg")), ""});
  } else {
    tiles.push_back({"Drops", count_text(last(run.history, "drops")), ""});
  }
  tiles.push_back({"Volume drift", number_text(drift, 2), ""});
  if (run.drops) {
    const double sum = volume_correction_sum(*run.drops).value_or(nan);
    tiles.push_back({"Volume corrections, sum", number_text(sum, 2), "R₀"});
  }
  tiles.push_back({"Surface nodes", count_text(last(run.history, "surface_nodes")), ""});
  tiles.push_back({"Tetrahedra", count_text(tetrahedra), ""});
  if (run.facts.wall_seconds > 0.0) {
    tiles.push_back({"Wall time", duration_text(run.facts.wall_seconds), ""});
  }
  std::string text = "<dl class=\"tiles\">";
  for (const Tile& tile : tiles) {
    if (tile.value == "–") continue;
    text += fmt::format("<div><dt>{}</dt><dd>{}{}</dd></div>", tile.name, tile.value,
                        tile.unit.empty() ? "" : " <small>" + tile.unit + "</small>");
  }
  return text + "</dl>\n";
}

std::string drops_html(const RunData& run) {
  const std::vector<double> ids = column(run.drops, "drop"), steps = column(run.drops, "step");
  if (ids.empty() || ids.size() != steps.size()) return {};
  const std::vector<std::pair<const char*, const char*>> quantities = {
      {"L", "L"},      {"B", "B"},    {"W", "W"}, {"D", "D"}, {"angle_deg", "θ [°]"},
      {"volume", "V"}, {"area", "S"}, {"x", "x"}, {"y", "y"}, {"z", "z"}};
  std::string head, body;
  std::vector<std::vector<double>> columns;
  for (const auto& [name, symbol] : quantities) {
    std::vector<double> values = column(run.drops, name);
    if (values.empty()) continue;
    head += fmt::format("<th class=\"n\">{}</th>", symbol);
    columns.push_back(std::move(values));
  }
  const double step = last_whole_step(run, steps);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (steps[i] != step) continue;
    std::string cells;
    for (const std::vector<double>& values : columns)
      cells += fmt::format("<td class=\"n\">{}</td>", decimal_text(values[i], decimals));
    body += fmt::format("<tr><th>drop {}</th>{}</tr>\n", count_text(ids[i]), cells);
  }
  return fmt::format(
      "<div class=\"card scroll\"><table><caption>Drops at the end</caption>"
      "<thead><tr><th></th>{}</tr></thead><tbody>{}</tbody></table></div>\n",
      head, body);
}

std::string facts_html(const RunData& run) {
  const RunFacts& f = run.facts;
  const std::string program = f.program + (f.version.empty() ? "" : " " + f.version);
  const std::string nodes = count_text(last(run.history, "nodes"));
  std::string rows = row("Program", program) + row("Commit", f.commit) + row("Case", f.case_file) +
                     row("Status", f.status);
  rows += row("Capillary force", in_words(f.case_value("interface.surface-tension"))) +
          row("Elements", f.case_value("solver.elements")) +
          row("Linear solver", f.case_value("solver.linear")) +
          row("Time scheme", f.case_value("time.scheme")) +
          row("Domain", in_words(f.case_value("domain.shape")));
  rows += row("Nodes at the end", nodes == "–" ? "" : nodes) + row("Host", f.host) +
          row("Ranks", f.ranks) + row("Started", f.started) + row("Finished", f.finished);
  if (rows.empty()) return {};
  return "<div class=\"card\"><table><caption>What ran</caption><tbody>" + rows +
         "</tbody></table></div>\n";
}

std::string phases_html(const RunData& run) {
  double total = 0.0, longest = 0.0;
  for (const auto& [phase, seconds] : run.facts.seconds) {
    total += seconds;
    longest = std::max(longest, seconds);
  }
  if (!(longest > 0.0)) return {};
  std::string rows;
  for (const auto& [phase, seconds] : run.facts.seconds) {
    rows += fmt::format(
        "<tr><th>{}</th><td class=\"phase\"><span style=\"width:{:.1f}%\"></span></td>"
        "<td class=\"n\">{}</td><td class=\"n\">{:.0f} %</td></tr>\n",
        markup_text(in_words(phase)), 100.0 * seconds / longest, duration_text(seconds),
        100.0 * seconds / total);
  }
  return "<div class=\"card\"><table><caption>Time by phase</caption><tbody>" + rows +
         "</tbody></table></div>\n";
}

std::string case_html(const RunData& run) {
  std::string text;
  if (!run.facts.case_text.empty()) {
    text += fmt::format("<details><summary>Case file</summary><pre>{}</pre></details>\n",
                        markup_text(run.facts.case_text));
  }
  if (run.facts.case_values.empty()) return text;
  std::string rows;
  for (const auto& [key, value] : run.facts.case_values) {
    rows += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", markup_text(key), markup_text(value));
  }
  return text + "<details><summary>Case with all defaults</summary><table><tbody>" + rows +
         "</tbody></table></details>\n";
}

}  // namespace meniscus::report
