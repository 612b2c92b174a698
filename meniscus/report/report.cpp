#include "meniscus/report/report.hpp"

#include <string>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/page.hpp"
#include "meniscus/report/page_bundle.hpp"
#include "meniscus/report/page_data.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/summary.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

std::string end_html(const RunData& run) {
  return "<h2>The run</h2>\n<div class=\"columns\">\n" + facts_html(run) + phases_html(run) +
         "</div>\n" + drops_html(run) + case_html(run);
}

std::string title_of(const RunData& run) {
  return run.facts.title.empty() ? "A run of Meniscus" : run.facts.title;
}

PageUnits units_of(const RunData& run) {
  return run.facts.is_quiescent() ? PageUnits::at_rest : PageUnits::of_rate;
}

std::string page_html(RunData& run) {
  const PageBudget budget;
  PageRun packed = page_run(run, budget);
  const DrawingData data =
      drawing_data("report", std::span(&run, 1), std::span(&packed, 1), budget);
  return whole_page(
      {.title = title_of(run),
       .content = heading_html(run) + tiles_html(run) + "<div id=\"app\"></div>\n" + end_html(run),
       .data = data_elements(data),
       .units = units_of(run)});
}

}  // namespace

std::string live_page(const fs::path& run_directory, std::string_view id) {
  if (!has_page_bundle()) {
    reject_input(
        "--watch: this program was built without the page's script; install node and npm and build "
        "again");
  }
  const RunData run = load_run(run_directory);
  PageParts parts{.title = title_of(run), .content = {}, .data = {}, .is_live = true};
  parts.units = units_of(run);
  parts.data = data_elements(live_drawing_data(run, id));
  parts.content = heading_html(run) + "<div id=\"app\"></div>\n<h2>The run</h2>\n" +
                  facts_html(run) + case_html(run);
  return whole_page(parts);
}

LivePart live_surface(const fs::path& path, double t) {
  // A live page fetches one frame at a time, so frames may be larger than in a page that holds all.
  constexpr int most_live_faces = 60000;
  const SurfaceFrame whole = load_surface(path, t);
  PackedFrame frame = packed_surface(coarse_frame(whole, most_live_faces));
  frame.num_faces_of_run = whole.mesh.num_faces();
  return {entry_json(frame), std::move(frame.bytes)};
}

LivePart live_cuts(const fs::path& path, double t) {
  PackedFrame cuts = packed_cuts(t, load_cuts(path));
  return {entry_json(cuts), std::move(cuts.bytes)};
}

void write_report(const fs::path& run_directory) {
  RunData run = load_run(run_directory);
  io::write_file(run_directory / io::RunFiles::page, page_html(run));
}

}  // namespace meniscus
