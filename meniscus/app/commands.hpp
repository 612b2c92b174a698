#pragma once

#include <optional>
#include <string>
#include <vector>

namespace meniscus {

struct RunArguments {
  std::string case_file;
  std::string output;                  ///< empty: the case file's name without its ending
  std::vector<std::string> overrides;  ///< key=value
  bool is_overwrite = false;
  bool is_quiet = false;
};
/// `meniscus run`. Returns the exit status; so do all below.
int run_command(const RunArguments& arguments);

struct ResumeArguments {
  std::string directory;
  std::optional<double> until;  ///< a new end
  std::string from;             ///< a checkpoint file; empty: the newest of the directory
  std::string output;           ///< with `from`: the new folder
  bool is_quiet = false;
};
int resume_command(const ResumeArguments& arguments);

struct MeshArguments {
  std::string case_file;
  std::string output;  ///< .vtu; empty: only the table is printed
  std::vector<std::string> overrides;
};
int mesh_command(const MeshArguments& arguments);

struct ReportArguments {
  std::string directory;
  bool is_svg = false;  ///< stills instead of the page: interface.svg and history.svg
};
int report_command(const ReportArguments& arguments);
int explain_command(const std::string& key);
/// Lists the examples, or writes the named one into the working directory.
int examples_command(const std::string& name, bool is_overwrite);

}  // namespace meniscus
