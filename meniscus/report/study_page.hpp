#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

/// A run of a study on its page.
struct StudyPageRun {
  std::string name, outcome = {};
  std::filesystem::path folder;
  std::string link = {};  ///< to the run's page, from the study's; empty: none
  bool is_shown = false;  ///< its last shape is drawn
};

/// What the page of a study shows.
struct StudyPage {
  std::string title, lead;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<Plot> plots;
  std::vector<StudyPageRun> runs;
};

/// Writes the page: plots, the last shapes of the runs that are shown at one scale, the table, and
/// links to the pages of the runs. Throws RunFailure when the file cannot be written.
void write_study_page(const StudyPage& page, const std::filesystem::path& file);

}  // namespace meniscus::report
