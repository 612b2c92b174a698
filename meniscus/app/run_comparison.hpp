#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meniscus/case/check_file.hpp"
#include "meniscus/io/table.hpp"

namespace meniscus {

/// The rows of one run that checks read.
struct RunTables {
  io::Table drops, history;
  io::Table events = {};  ///< without columns where nothing happened
};

/// One quantity as a function of another, ordered as the run made it.
struct Series {
  std::vector<double> x, y;
};
/// `column` of a drop's rows (or of the history) against the column `over`; rows where either is
/// empty are left out. Throws InvalidInput when neither table has the column.
[[nodiscard]] Series series_of(const RunTables& run, const CheckedQuantity& quantity);
/// The value of the series where it first passes x; none where it never does. Cubic through two
/// rows on either side, linear at an end or where the abscissa turns back. Records keep some
/// hundred rows: linear interpolation would miss up to 0.1 % of a curved quantity.
[[nodiscard]] std::optional<double> value_at(const Series& series, double x);

/// A measured value beside its reference.
struct Deviation {
  double at = 0.0;  ///< value of `over`, for a curve
  double reference = 0.0, measured = 0.0;
  double deviation = 0.0;  ///< measured/reference − 1, or the difference if the check is absolute
};

/// One row of the table of checks.
struct CheckRow {
  std::string case_name, run, quantity;
  std::optional<Deviation> worst;  ///< none: nothing could be compared; `note` says why
  int compared = 0;                ///< number of points of a curve
  std::optional<double> tolerance;
  bool is_absolute = false;
  std::string note;

  [[nodiscard]] bool is_held() const { return tolerance.has_value(); }
  [[nodiscard]] bool passes() const;
};

/// Compares the runs of a case, by name, with its references: a row for each quantity, each
/// extrapolation and the volume drift of each run. A run that is missing gives rows without a
/// value. `reference` is the case's reference.csv, if it has one.
[[nodiscard]] std::vector<CheckRow> compare(const std::string& case_name, const CheckFile& check,
                                            const std::map<std::string, RunTables>& runs,
                                            const std::optional<io::Table>& reference);

}  // namespace meniscus
