#pragma once

#include <span>
#include <string>
#include <vector>

#include "meniscus/report/packed_frames.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// What the page shows of one run, packed.
struct PageRun {
  std::string name;                       ///< of its folder
  std::vector<PackedFrame> frames, cuts;  ///< in the order of time
  std::vector<std::string> notes;         ///< what was left out to keep the page small
};

/// How large the parts of a page may become, in characters of base 64. Together with the pictures,
/// the scripts and the texts they stay below 20 MB, what a mail or a browser on a phone bears.
struct PageBudget {
  std::size_t frames = 12'500'000, cuts = 2'500'000, tables = 3'000'000;
  std::size_t most_frames = 400, most_cuts = 24;  ///< as many as a slider can tell apart
};

/// Packs the frames of a run and cuts of its volume meshes; where they exceed the budget, some are
/// left out or made coarser, and the notes say so. Files that cannot be read join the run's faults.
[[nodiscard]] PageRun packed_run(RunData& run, const PageBudget& budget);

/// The run as the page's script reads it: a `script` element of JSON with the id `page-data` and
/// one of text in base 64 for every frame, cut and table. `kind` is report, live or comparison.
[[nodiscard]] std::string data_elements(std::string_view kind, std::span<const RunData> runs,
                                        std::span<PageRun> pages, const PageBudget& budget);

/// The `page-data` of a run that is still going on: the page asks for tables and frames.
[[nodiscard]] std::string live_data_element(const RunData& run);

/// What the page must know of a frame or cut before it has its bytes, as JSON.
[[nodiscard]] std::string entry_json(const PackedFrame& frame);

/// The two cuts of one file, through the middle of the drops normal to the z- and the y-axis.
[[nodiscard]] std::vector<MeshCut> load_cuts(const std::filesystem::path& path);

}  // namespace meniscus::report
