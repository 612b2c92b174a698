#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

/// For pictures that no page has to carry: tables with all their rows.
inline constexpr PageBudget whole_tables{.tables = std::numeric_limits<std::size_t>::max()};

/// Packs the frames of a run and cuts of its volume meshes. Where they exceed the budget, some are
/// left out or coarsened, and the notes say so. Unreadable files are added to the run's faults.
[[nodiscard]] PageRun page_run(RunData& run, const PageBudget& budget);

/// What pictures are drawn from, by the page's script or by node. It has `page`, JSON that says
/// what there is, and by id a base-64 text for every frame, cut and table.
struct DrawingData {
  std::string page;
  std::vector<std::pair<std::string, std::string>> texts = {};
};

/// The data of runs. `kind` is report or comparison.
[[nodiscard]] DrawingData drawing_data(std::string_view kind, std::span<const RunData> runs,
                                       std::span<PageRun> pages, const PageBudget& budget);

/// The data of a run that still computes: the page asks for tables and frames of the server `id`.
[[nodiscard]] DrawingData live_drawing_data(const RunData& run, std::string_view id);

/// The data of a study: `plots` and `shapes` in JSON (web/src/study.js), and the frames of the
/// shapes.
[[nodiscard]] DrawingData study_drawing_data(std::string_view plots, std::string_view shapes,
                                             const std::vector<PackedFrame>& frames);

/// The data as `script` elements, the JSON with the id `page-data`.
[[nodiscard]] std::string data_elements(const DrawingData& data);

/// Packs given frames and volume meshes of a run, as they are. Unreadable files are added to the
/// run's faults.
[[nodiscard]] PageRun picture_run(RunData& run, std::span<const io::PvdEntry> frames,
                                  std::span<const io::PvdEntry> volume_frames);

/// The facts about a frame or cut that the page needs before its bytes, as JSON.
[[nodiscard]] std::string entry_json(const PackedFrame& frame);

/// The two cuts of one file, through the middle of the drops normal to the z- and the y-axis.
[[nodiscard]] std::vector<MeshCut> load_cuts(const std::filesystem::path& path);

}  // namespace meniscus::report
