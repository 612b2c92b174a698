#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// A quantity of a run that is compared: with what, and within which tolerance.
struct CheckedQuantity {
  enum class Measure { curve, largest, smallest, last };

  std::string column;             ///< of drops.csv, else of history.csv
  std::optional<int> event;       ///< row of events.csv, from 0; then `column` is one of events.csv
  int drop = 0;                   ///< id of the drop in drops.csv
  bool is_of_all_drops = false;   ///< the extreme over all drops, whatever their ids
  std::optional<int> minus_drop;  ///< id of a drop whose column is subtracted
  Measure measure = Measure::curve;
  std::string over = "t";  ///< the column of a curve's abscissa
  std::vector<double> at;  ///< abscissae; empty: those of the reference
  std::string against;     ///< name of another run (or extrapolation) of the file, else empty
  std::optional<double> reference;  ///< a number, else the column of that name in reference.csv
  std::string source;               ///< where `reference` is from
  std::optional<double> tolerance;  ///< largest deviation; none: the deviation is reported only
  bool is_magnitude = false;  ///< |value|: where mirror images are as good, as in a symmetric case
  bool is_absolute = false;   ///< deviation and tolerance are differences, not ratios
};

struct CheckedRun {
  std::string name;
  std::vector<std::string> overrides;  ///< key=value
  bool is_short = false;               ///< cheap enough for every test
  std::vector<CheckedQuantity> quantities;
  bool is_once = false;  ///< so costly that it is made on request only
  /// [R0] upper bound on the sum of a drop's volume corrections. The largest among the recorded
  /// runs is some 0.07, of two drops of 59 nodes.
  double most_correction = 0.1;
};

/// The limit N0 → ∞ of one quantity from runs at several N0, by least squares of a + b N0^−order.
struct CheckedExtrapolation {
  std::string name;
  std::vector<std::string> runs;
  std::vector<double> nodes;  ///< N0 of each run
  double order = 1.0;
  CheckedQuantity quantity;
};

/// check.toml of a validation case: the runs of its case.toml and the checks on them.
struct CheckFile {
  std::vector<CheckedRun> runs;
  std::vector<CheckedExtrapolation> extrapolations;
};

/// Throws InvalidInput naming file, line and key at the first fault.
[[nodiscard]] CheckFile read_check_file(const std::filesystem::path& file);

}  // namespace meniscus
