#pragma once

#include <span>
#include <string>
#include <vector>

#include "meniscus/report/run_data.hpp"

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

/// The specification of a plot of a run's history. The browser draws it on the page, the program in
/// pictures. A `*` in title, columns and labels stands for the name of a bulk scalar: each scalar
/// of a run has a plot of its own.
struct PlotSpec {
  std::string group, title, unit;
  std::string table;  ///< history, drops or timing
  std::vector<PlotQuantity> quantities;
  bool is_log = false, includes_zero = false;  ///< properties of the axis of values
  Derivation derivation = Derivation::none;
};

/// All plots; those of one group are consecutive.
[[nodiscard]] std::span<const PlotSpec> plot_catalogue();
/// The plots of runs: the catalogue, its plots of bulk scalars for each that the tables name.
[[nodiscard]] std::vector<PlotSpec> plots_of(std::span<const RunData> runs);
/// The catalogue as a JSON list of objects, for the page.
[[nodiscard]] std::string plot_catalogue_json();

}  // namespace meniscus::report
