#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/io/table.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus::report {

/// What run.json says, as text for readers; empty where it says nothing.
struct RunFacts {
  std::string title, status, program, version, commit, case_file, case_text, host;
  std::string started, finished, ranks, steps, t;
  double wall_seconds = 0.0;
  std::vector<std::pair<std::string, double>> seconds;           ///< by phase, in their order
  std::vector<std::pair<std::string, std::string>> case_values;  ///< "flow.kind" to "simple-shear"
  std::vector<std::string> warnings;

  /// The value of a key of the case; empty if it is not there.
  [[nodiscard]] std::string case_value(const std::string& key) const;
};

/// The files of a run's folder, as far as they are there; `faults` names those that are but cannot
/// be read.
struct RunData {
  std::filesystem::path folder;
  RunFacts facts;
  std::optional<io::Table> history, drops, events, timing;
  std::optional<io::Table> reference;  ///< what the case is compared with: `t` and columns of above
  std::vector<io::PvdEntry> frames;    ///< of the surface, in the order of time
  std::vector<io::PvdEntry> volume_frames;  ///< likewise
  std::vector<std::string> faults;
};

/// Throws InvalidInput when the folder holds neither run.json nor history.csv.
[[nodiscard]] RunData load_run(const std::filesystem::path& folder);

}  // namespace meniscus::report
