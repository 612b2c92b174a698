#include <string>
#include <utility>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/report/rasterize.hpp"
#include "meniscus/report/report.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/stills.hpp"

namespace meniscus {

namespace fs = std::filesystem;
using namespace report;

std::vector<std::string> write_stills(const fs::path& run_directory, StillFormat format,
                                      std::span<const double> times) {
  constexpr double png_scale = 2.0;  // at least 300 dots per inch in a journal column of 85 mm
  RunData run = load_run(run_directory);
  const std::pair<const char*, std::string> pictures[] = {{"interface", interface_svg(run, times)},
                                                          {"deformation", deformation_svg(run)},
                                                          {"mesh", mesh_svg(run, times)},
                                                          {"history", history_svg(run)}};
  std::vector<std::string> names;
  for (const auto& [name, svg] : pictures) {
    if (svg.empty()) continue;
    const bool is_png = format == StillFormat::png;
    names.push_back(std::string(name) + (is_png ? ".png" : ".svg"));
    io::write_file(run_directory / names.back(), is_png ? png_of(svg, png_scale) : svg);
  }
  if (names.empty()) {
    reject_input("{}: no frame, mesh or history that a picture could show{}",
                 run_directory.string(), run.faults.empty() ? "" : "; " + run.faults.front());
  }
  return names;
}

}  // namespace meniscus
