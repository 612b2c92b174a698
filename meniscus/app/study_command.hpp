#pragma once

#include <optional>
#include <string>

namespace meniscus {

struct StudyArguments {
  std::string study_file;
  std::string output;  ///< empty: the study file's name without its ending
  /// Runs at a time; none: 1, under Slurm no bound.
  std::optional<int> jobs = {};
  bool is_slurm = false;  ///< hands the runs to Slurm
  int ranks = 1;          ///< processors of each run, under Slurm
  bool is_overwrite = false;
  bool is_quiet = false;
};
/// `meniscus study`. Returns the exit status.
int study_command(const StudyArguments& arguments);

}  // namespace meniscus
