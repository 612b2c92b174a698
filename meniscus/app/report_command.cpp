#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/app/commands.hpp"
#include "meniscus/app/run_directory.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/report/report.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

void require_run(const std::string& folder) {
  if (!holds_run(folder)) reject_input("{} does not hold a run", folder);
}

void write_still_pictures(const fs::path& folder, StillFormat format,
                          const std::vector<double>& times) {
  for (const std::string& name : write_stills(folder, format, times))
    fmt::print("wrote {}\n", (folder / name).string());
}

}  // namespace

int report_command(const ReportArguments& arguments) {
  require_run(arguments.directory);
  const fs::path folder(arguments.directory);
  if (!arguments.times.empty() && !arguments.is_svg && !arguments.is_png)
    reject_input("--times is for stills: give --svg or --png too");
  if (arguments.is_svg) write_still_pictures(folder, StillFormat::svg, arguments.times);
  if (arguments.is_png) write_still_pictures(folder, StillFormat::png, arguments.times);
  if (arguments.is_movie) {
    write_movie(folder, folder / "interface.mp4");
    fmt::print("wrote {}\n", (folder / "interface.mp4").string());
  }
  if (!arguments.is_svg && !arguments.is_png && !arguments.is_movie) write_report(folder);
  return 0;
}

int compare_command(const CompareArguments& arguments) {
  for (const std::string& folder : arguments.directories) require_run(folder);
  const std::vector<fs::path> folders(arguments.directories.begin(), arguments.directories.end());
  const fs::path out(arguments.output);
  if (fs::is_directory(out) || !fs::is_directory(fs::absolute(out).parent_path()))
    reject_input("-o {}: not a file in a folder that exists", arguments.output);
  write_comparison(folders, out);
  fmt::print("wrote {}\n", out.string());
  return 0;
}

}  // namespace meniscus
