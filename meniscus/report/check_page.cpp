#include "meniscus/report/check_page.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/page.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

constexpr std::size_t kColumns = 9;
constexpr std::array<const char*, kColumns> kHeadings = {
    "case", "run", "quantity", "at", "reference", "measured", "deviation", "tolerance", "verdict"};

std::array<std::string, kColumns> cells(const CheckLine& line) {
  return {line.case_name, line.run,       line.quantity,  line.at,           line.reference,
          line.measured,  line.deviation, line.tolerance, word(line.verdict)};
}

/// Width of a text in columns: continuation bytes of UTF-8 take none.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded_text(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, width_of(text)), ' ');
}

}  // namespace

const char* word(CheckLine::Verdict verdict) {
  switch (verdict) {
    case CheckLine::Verdict::passed:
      return "passed";
    case CheckLine::Verdict::failed:
      return "FAILED";
    case CheckLine::Verdict::reported:
      return "reported";
    case CheckLine::Verdict::missing:
      return "missing";
  }
  return "";
}

std::string check_text(const std::vector<CheckLine>& lines) {
  std::array<std::size_t, kColumns> widths{};
  for (std::size_t k = 0; k < kColumns; ++k) widths[k] = width_of(kHeadings[k]);
  for (const CheckLine& line : lines) {
    const auto row = cells(line);
    for (std::size_t k = 0; k < kColumns; ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  }
  std::string text;
  const auto add = [&](const auto& row) {
    for (std::size_t k = 0; k + 1 < kColumns; ++k) text += padded_text(row[k], widths[k]) + "  ";
    text += row[kColumns - 1];
    text += '\n';
  };
  add(kHeadings);
  for (const CheckLine& line : lines) add(cells(line));
  return text;
}

void write_check_page(const std::vector<CheckLine>& lines, const std::string& provenance,
                      const std::filesystem::path& file) {
  std::string text = "<h1>Validation</h1>\n<p>" + markup_text(provenance) +
                     "</p>\n<div class=\"card\"><table>\n<tr>";
  for (const char* heading : kHeadings) text += fmt::format("<th>{}</th>", heading);
  text += "</tr>\n";
  for (const CheckLine& line : lines) {
    text += "<tr>";
    for (const std::string& cell : cells(line)) text += "<td>" + markup_text(cell) + "</td>";
    text += "</tr>\n";
  }
  text += "</table></div>\n";
  io::write_file(file, whole_page({.title = "Meniscus: validation", .content = text, .data = {}}));
}

}  // namespace meniscus::report
