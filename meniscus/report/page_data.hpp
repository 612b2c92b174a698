#pragma once

#include <span>
#include <string>
#include <vector>

#include "meniscus/report/packed_frames.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// The packed data of one run for the page.
struct PageRun {
  std::string name;                       ///< of its folder
  std::vector<PackedFrame> frames, cuts;  ///< in the order of time
  std::vector<std::string> notes;         ///< says what was left out to keep the page small
};

/// The largest sizes of the parts of a page, in characters of base 64. With pictures, scripts and
/// texts the page stays below 20 MB, which fits into a mail and a phone's browser.
struct PageBudget {
  std::size_t frames = 12'500'000, cuts = 2'500'000, tables = 3'000'000;
  std::size_t most_frames = 400, most_cuts = 24;  ///< a slider resolves no more
};

/// Packs the frames of a run and cuts of its volume meshes. Where they exceed the budget, some are
/// left out or coarsened, and the notes say so. Unreadable files are added to the run's faults.
[[nodiscard]] PageRun page_run(RunData& run, const PageBudget& budget);

/// The data elements for the page's script: a `script` element of JSON with the id `page-data`, and
/// one of base-64 text for every frame, cut and table. `kind` is report, live or comparison.
[[nodiscard]] std::string data_elements(std::string_view kind, std::span<const RunData> runs,
                                        std::span<PageRun> pages, const PageBudget& budget);

/// The `page-data` of a run that still computes: the page asks for tables and frames.
[[nodiscard]] std::string live_data_element(const RunData& run);

/// The facts about a frame or cut that the page needs before its bytes, as JSON.
[[nodiscard]] std::string entry_json(const PackedFrame& frame);

/// The two cuts of one file, through the middle of the drops normal to the z- and the y-axis.
[[nodiscard]] std::vector<MeshCut> load_cuts(const std::filesystem::path& path);

}  // namespace meniscus::report
