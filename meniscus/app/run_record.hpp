#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "meniscus/app/simulation.hpp"
#include "meniscus/case/case.hpp"

namespace meniscus {

/// Writes run.json: what ran, where, when, and how it ended. Only run.json and timing.csv depend on
/// the clock or the host.
class RunRecord {
 public:
  /// `warnings`: of the case's surfaces. `inputs`: `case_inputs` before they were read.
  RunRecord(const Case& c, std::string case_file, std::string case_text,
            std::vector<std::string> warnings = {}, std::map<std::string, std::string> inputs = {});

  /// Adds the seconds, steps and warnings of an earlier part of the run, read from its run.json.
  void go_on_from(const std::filesystem::path& folder);
  /// The case as it was changed after a step: the keys that were set, each as "key=value".
  void change_case(const Case& c, std::int64_t step, double t,
                   const std::vector<std::string>& settings);
  void write(const Simulation& simulation, const std::string& status) const;

 private:
  std::string case_file_, case_text_, case_json_;
  std::map<std::string, std::string> inputs_;  // `case_inputs`
  std::string dimensionless_json_;             // empty: the case has no [scale]
  std::string title_;
  std::string changes_json_;  // an array; empty: the case was never changed
  std::string started_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::vector<std::string> warnings_;  // beside the notices of the evolution
  std::vector<std::pair<std::string, double>> seconds_before_;
  double wall_before_ = 0.0;
};

}  // namespace meniscus
