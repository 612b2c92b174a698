#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "meniscus/surface/constants.hpp"

namespace meniscus {

class Evolution;
/// Changes the state of a new run before anything is written, for example adds fields to it.
using SetUp = std::function<void(Evolution&)>;

/// Whether and where the page of a run is served while it computes.
struct WatchArguments {
  bool is_on = false;
  std::string address = "127.0.0.1";
  int port = 8642;
};

struct RunArguments {
  std::string case_file;
  std::string output;                  ///< empty: the case file's name without its ending
  std::vector<std::string> overrides;  ///< key=value
  bool is_overwrite = false;
  bool is_quiet = false;
  WatchArguments watch = {};
  SetUp set_up = {};  ///< called after the first meshes are made
};
/// `meniscus run`. All commands return the exit status.
int run_command(const RunArguments& arguments);

struct ResumeArguments {
  std::string directory;
  std::optional<double> until;  ///< a new end
  std::string from;             ///< a checkpoint file; empty: the newest of the directory
  std::string output;           ///< with `from`: the new folder
  std::vector<std::string> overrides = {};  ///< key=value, with `from`
  bool is_quiet = false;
  WatchArguments watch = {};
};
int resume_command(const ResumeArguments& arguments);

struct MeshArguments {
  std::string case_file;
  std::string output;  ///< .vtu; empty: only the table is printed
  std::vector<std::string> overrides;
};
int mesh_command(const MeshArguments& arguments);

struct RemeshArguments {
  std::string surface;
  std::string output;  ///< empty: the surface's name with "-remeshed"
  std::optional<double> nodes, edge_length,
      chordal_error;  ///< all empty: keeps the number of vertices
  double edge_floor = 0.0;
  double gradation = kGradation;
  bool is_repair = false;
  bool is_json = false;
  bool is_overwrite = false;
};
int remesh_command(const RemeshArguments& arguments);

struct ReportArguments {
  std::string directory;
  bool is_svg = false, is_png = false;  ///< stills instead of the page
  bool is_movie = false;                ///< interface.mp4 instead of the page
  std::vector<double> times;            ///< of the stills [1/G]; none: evenly spaced over the run
};
int report_command(const ReportArguments& arguments);

struct CompareArguments {
  std::vector<std::string> directories;
  std::string output = "comparison.html";
};
int compare_command(const CompareArguments& arguments);

struct CheckArguments {
  std::vector<std::string> directories;
  std::string cases;   ///< where --all and bare names look [cases/ here, else those shipped]
  std::string output;  ///< runs, and check.html [out/check]; with `against` a table [none]
  bool is_all = false;
  bool is_short = false;          ///< only the runs marked short
  bool is_once = false;           ///< also the runs marked once
  std::vector<std::string> runs;  ///< only those of these names; empty: all
  bool is_recorded = false;       ///< compares the results kept beside the cases, runs nothing
  bool is_record = false;         ///< keeps the results there
  bool is_quiet = false;
  std::string against;  ///< a table to hold against the one benchmark that `directories` names
  std::vector<std::string> columns;  ///< with `against`, only these; empty: all of the benchmark
  bool is_list = false;              ///< lists the benchmarks, does nothing else
};
int check_command(CheckArguments arguments);

int explain_command(const std::string& key);
/// Lists the examples, or writes the named one into the working directory.
int examples_command(const std::string& name, bool is_overwrite);

}  // namespace meniscus
