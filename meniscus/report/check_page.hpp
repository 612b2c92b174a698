#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace meniscus::report {

/// A line of the table of checks, as text.
struct CheckLine {
  std::string case_name, run, quantity, at, reference, measured, deviation, tolerance;
  enum class Verdict { passed, failed, reported, missing } verdict = Verdict::reported;
};

[[nodiscard]] const char* word(CheckLine::Verdict verdict);
/// The table of checks in aligned columns, for a terminal.
[[nodiscard]] std::string check_text(const std::vector<CheckLine>& lines);
/// Writes the table of checks as an HTML page. Throws RunFailure when the file cannot be written.
void write_check_page(const std::vector<CheckLine>& lines, const std::string& provenance,
                      const std::filesystem::path& file);

}  // namespace meniscus::report
