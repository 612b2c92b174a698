#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/io/table.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus::report {

/// The entries of run.json as text for readers; empty where an entry is missing.
struct RunFacts {
  std::string title, status, program, version, commit, case_file, case_text, host;
  std::string started, finished, ranks, steps, t;
  double wall_seconds = 0.0;
  std::vector<std::pair<std::string, double>>
      seconds;  ///< seconds by phase, in the order of run.json
  std::vector<std::pair<std::string, std::string>>
      case_values;  ///< such as "flow.kind" and "simple-shear"
  std::vector<std::string> warnings;

  /// Of a case with [scale], whose keys have SI units, numbers in the run's: end, Ca, Re.
  std::vector<std::pair<std::string, std::string>> numbers;

  /// The value of a case key; empty if the case lacks it.
  [[nodiscard]] std::string case_value(const std::string& key) const;
  /// The entry of `numbers`; of a case without [scale] the value of the key.
  [[nodiscard]] std::string dimensionless(const std::string& number, const std::string& key) const;
  /// Whether nothing imposes a rate: times are in μR0/σ and stresses in σ/R0 (docs/notation.md).
  [[nodiscard]] bool is_quiescent() const;
};

/// The files of a run's folder, as far as they exist. `faults` names those that cannot be read.
struct RunData {
  std::filesystem::path folder;
  RunFacts facts;
  std::optional<io::Table> history, drops, events, timing;
  std::optional<io::Table>
      reference;                     ///< reference of the case: `t` and columns of the tables above
  std::vector<io::PvdEntry> frames;  ///< surface frames in the order of time
  std::vector<io::PvdEntry> volume_frames;  ///< volume frames in the order of time
  std::vector<std::string> faults;
};

/// Throws InvalidInput when the folder holds neither run.json nor history.csv.
[[nodiscard]] RunData load_run(const std::filesystem::path& folder);

}  // namespace meniscus::report
