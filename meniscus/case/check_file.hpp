#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// What of a run is compared, with what, and how near it must come.
struct CheckedQuantity {
  enum class Measure { curve, largest, smallest, last };

  std::string column;             ///< of drops.csv, else of history.csv
  std::optional<int> event;       ///< row of events.csv, from 0, that the column is of instead
  int drop = 0;                   ///< whose row of drops.csv
  std::optional<int> minus_drop;  ///< the column of this drop is taken off
  Measure measure = Measure::curve;
  std::string over = "t";  ///< the column a curve is a function of
  std::vector<double> at;  ///< its places; empty: those of the reference
  std::string against;     ///< name of another run (or extrapolation) of the file, else empty
  std::optional<double> reference;  ///< a number, else the column of that name in reference.csv
  std::string source;               ///< where that number is from
  std::optional<double> tolerance;  ///< of the deviation; none: reported only
  bool is_absolute = false;         ///< deviation and tolerance are differences, not ratios
};

struct CheckedRun {
  std::string name;
  std::vector<std::string> overrides;  ///< key=value
  bool is_short = false;               ///< cheap enough for every test
  std::vector<CheckedQuantity> quantities;
  bool is_once = false;  ///< so costly that it is made only when it is asked for
  /// [R0] the most that the volume corrections of a drop may add up to. The largest of the runs
  /// recorded beside the cases, two drops of 59 nodes, have some 0.07.
  double most_correction = 0.1;
};

/// The limit N0 → ∞ of one quantity, from the runs at several N0: least squares of
/// a + b N0^−order.
struct CheckedExtrapolation {
  std::string name;
  std::vector<std::string> runs;
  std::vector<double> nodes;  ///< N0 of each
  double order = 1.0;
  CheckedQuantity quantity;
};

/// check.toml of a validation case: which runs of its case.toml are held to what.
struct CheckFile {
  std::vector<CheckedRun> runs;
  std::vector<CheckedExtrapolation> extrapolations;
};

/// Throws InvalidInput naming file, line and key at the first fault.
[[nodiscard]] CheckFile read_check_file(const std::filesystem::path& file);

}  // namespace meniscus
