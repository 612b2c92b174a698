#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// The difference of one quantity between two runs, both linear between their rows.
struct Difference {
  std::string quantity;  ///< column of drops.csv
  int drop = 0;
  double at_end = std::numeric_limits<double>::quiet_NaN();  ///< value of the run at the common end
  double first_at_end = at_end;                              ///< value of the first run there
  double largest = at_end;  ///< max |difference| over the rows of both within the common time
  double t_of_largest = at_end;
};

/// The time up to which all runs have rows [1/G]; NaN if one has none.
[[nodiscard]] double common_end(std::span<const RunData> runs);

/// The differences between a run and the first run, for every drop and shape measure that both
/// have.
[[nodiscard]] std::vector<Difference> differences(const RunData& first, const RunData& run,
                                                  double end);

/// Value at t of a curve that is linear between its points; NaN beyond its ends.
[[nodiscard]] double value_at(std::span<const double> x, std::span<const double> y, double t);

}  // namespace meniscus::report
