#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace meniscus::report {

/// One line of a plot; it has a gap where y is not finite.
struct Curve {
  std::string label = {};  ///< text in the legend
  std::vector<double> x = {}, y = {};
  int color = 0;  ///< number of the colour, from 0 on
  int dash = 0;   ///< 0 solid, 1 dashed, 2 dotted
};

/// A plot that the page's script draws (web/src/plot.js).
struct Plot {
  std::string title = {};    ///< the quantity
  std::string unit = {};     ///< of y, shown beside the title; empty: none
  std::string x_label = {};  ///< label of the x-axis
  std::vector<Curve> curves = {};
  bool is_log = false;  ///< of y
};

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

/// Writes the page: plots, the last shapes of the runs that are shown at one scale, and the table.
/// It links to the pages of the runs. Throws RunFailure when the file cannot be written.
void write_study_page(const StudyPage& page, const std::filesystem::path& file);

}  // namespace meniscus::report
