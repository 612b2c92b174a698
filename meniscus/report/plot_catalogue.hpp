#pragma once

#include <span>
#include <string>
#include <vector>

namespace meniscus::report {

struct PlotQuantity {
  std::string column, label;
};

/// How the columns of a plot become its curves.
enum class Derivation {
  none,          ///< each column as it is
  percent,       ///< the first column in per cent of the magnitude of the second
  sum,           ///< all columns but `step` and `t`, added
  gap_at_zeros,  ///< a 0 stands for no value
};

/// One plot of the history of a run, wherever it is drawn: on the page by the browser, in pictures
/// by the program.
struct PlotSpec {
  std::string group, title, unit;
  std::string table;  ///< history, drops or timing
  std::vector<PlotQuantity> quantities;
  bool is_log = false, includes_zero = false;  ///< of the axis of values
  Derivation derivation = Derivation::none;
};

/// All of them, those of a group one after the other.
[[nodiscard]] std::span<const PlotSpec> plot_catalogue();
/// The catalogue for the page: a list of objects in JSON.
[[nodiscard]] std::string plot_catalogue_json();

}  // namespace meniscus::report
