#pragma once

#include <string>

namespace meniscus {

struct StudyArguments {
  std::string study_file;
  std::string output;  ///< empty: the study file's name without its ending
  int jobs = 1;        ///< runs at a time
  bool is_overwrite = false;
  bool is_quiet = false;
};
/// `meniscus study`. Returns the exit status.
int study_command(const StudyArguments& arguments);

}  // namespace meniscus
