#include "meniscus/report/page_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/packing.hpp"

namespace meniscus::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::size_t size_in_base64(const PackedFrame& frame) { return (frame.bytes.size() + 2) / 3 * 4; }

std::size_t total_size(const std::vector<PackedFrame>& frames) {
  std::size_t total = 0;
  for (const PackedFrame& frame : frames) total += size_in_base64(frame);
  return total;
}

/// The result of `load` for each entry. Entries that cannot be read are added to the run's faults,
/// once.
std::vector<PackedFrame> load_all(RunData& run, std::span<const io::PvdEntry> entries,
                                  const std::function<PackedFrame(const fs::path&, double)>& load) {
  std::vector<PackedFrame> frames;
  for (const io::PvdEntry& entry : entries) {
    try {
      frames.push_back(load(run.folder / entry.file, entry.t));
    } catch (const InvalidInput& error) {
      if (std::ranges::find(run.faults, error.what()) == run.faults.end())
        run.faults.emplace_back(error.what());
    }
  }
  return frames;
}

PackedFrame load_frame(const fs::path& path, double t, int most_faces, bool is_flat = false) {
  SurfaceFrame whole = load_surface(path, t);
  if (is_flat) whole.middles = {};
  PackedFrame frame = packed_surface(coarse_frame(whole, most_faces));
  frame.num_faces_of_run = whole.mesh.num_faces();
  return frame;
}

/// The largest number of faces per frame with which all frames fit into the budget, if every face
/// takes the average size.
int affordable_faces(const std::vector<PackedFrame>& frames, std::size_t budget) {
  // `coarse_frame` misses the requested number of faces by some per cent.
  constexpr double safety = 0.85;
  std::vector<int> counts;
  double all = 0.0;
  for (const PackedFrame& frame : frames) {
    counts.push_back(frame.num_faces);
    all += frame.num_faces;
  }
  const double available =
      safety * all * static_cast<double>(budget) / static_cast<double>(total_size(frames));
  std::ranges::sort(counts);
  double used = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double each = (available - used) / static_cast<double>(counts.size() - i);
    if (counts[i] >= each) return std::max(64, static_cast<int>(each));
    used += counts[i];
  }
  return counts.back();
}

void pack_surfaces(PageRun& page, RunData& run, const PageBudget& budget) {
  const auto entries = evenly_spaced_frames(run.frames, static_cast<int>(budget.most_frames));
  if (entries.size() < run.frames.size()) {
    page.notes.push_back(fmt::format("{} of the run’s {} frames of the interface are shown.",
                                     entries.size(), run.frames.size()));
  }
  constexpr int all_faces = std::numeric_limits<int>::max();
  const auto load = [](int most_faces, bool is_flat) {
    return [most_faces, is_flat](const fs::path& path, double t) {
      return load_frame(path, t, most_faces, is_flat);
    };
  };
  page.frames = load_all(run, entries, load(all_faces, false));
  if (total_size(page.frames) <= budget.frames) return;
  if (std::ranges::any_of(page.frames, &PackedFrame::is_curved))
    page.frames = load_all(run, entries, load(all_faces, true));
  if (total_size(page.frames) <= budget.frames) {
    page.notes.emplace_back(
        "Faces are drawn flat, so that the page stays small; the files of the run have them "
        "curved.");
    return;
  }
  const int most_faces = affordable_faces(page.frames, budget.frames);
  page.frames = load_all(run, entries, load(most_faces, true));
  page.notes.push_back(
      fmt::format("Frames with more than {} triangles are drawn with about as many; the "
                  "files of the run have them all.",
                  most_faces));
}

void pack_cuts(PageRun& page, RunData& run, const PageBudget& budget) {
  if (budget.most_cuts == 0) return;
  const auto load = [](const fs::path& path, double t) { return packed_cuts(t, load_cuts(path)); };
  const auto entries = evenly_spaced_frames(run.volume_frames, static_cast<int>(budget.most_cuts));
  page.cuts = load_all(run, entries, load);
  while (total_size(page.cuts) > budget.cuts && page.cuts.size() > 1) {
    const std::size_t half = (page.cuts.size() + 1) / 2;
    std::vector<PackedFrame> kept;
    if (half > 1)
      for (const std::size_t k : evenly_spaced_numbers(page.cuts.size(), half))
        kept.push_back(std::move(page.cuts[k]));
    else
      kept.push_back(std::move(page.cuts.back()));
    page.cuts = std::move(kept);
  }
  if (page.cuts.size() < run.volume_frames.size()) {
    page.notes.push_back(fmt::format("{} of the run’s {} volume meshes are shown.",
                                     page.cuts.size(), run.volume_frames.size()));
  }
}

/// The number that a part of a text begins with; 0 where there is none.
std::int64_t leading_number(const std::string& text, std::size_t begin, std::size_t end) {
  std::int64_t number = 0;
  std::from_chars(text.data() + begin, text.data() + end, number);
  return number;
}

/// The header, every n-th step and the last one of a table whose first column is the step.
std::string rows_at_every(const std::string& text, std::int64_t n) {
  std::string result;
  // The line break before the last line, which may have one behind it or not.
  const std::size_t last = text.size() < 2 ? std::string::npos : text.rfind('\n', text.size() - 2);
  const std::int64_t last_step =
      last == std::string::npos ? 0 : leading_number(text, last + 1, text.size());
  bool is_header = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::int64_t step = leading_number(text, at, end);
    if (is_header || step % n == 0 || step == last_step) result.append(text, at, end - at);
    is_header = false;
    at = end;
  }
  return result;
}

/// A table of the run for the page, with fewer steps where it would be too large.
std::string table_text(PageRun& page, const io::RunTableFile& table, const fs::path& file,
                       std::size_t budget) {
  const std::string text = io::read_file(file);
  std::string result = base64(zlib_bytes(text));
  if (result.size() <= budget || !text.starts_with("step,")) return result;
  const auto n = static_cast<std::int64_t>(result.size() / budget + 1);
  page.notes.push_back(fmt::format(
      "The plots of {} show every {}th step and the last; the file has them all.", table.file, n));
  return base64(zlib_bytes(rows_at_every(text, n)));
}

Json in_json(const Vec3& x) { return Json::array({x.x(), x.y(), x.z()}); }

Json entry(const PackedFrame& frame) {
  Json ranges = Json::object();
  for (const auto& [name, range] : frame.ranges) ranges[name] = {range.low, range.high};
  return {{"t", frame.t},
          {"faces", frame.num_faces},
          {"faces_of_run", frame.num_faces_of_run},
          {"low", in_json(frame.low)},
          {"high", in_json(frame.high)},
          {"ranges", ranges}};
}

Json entries(const std::vector<PackedFrame>& frames) {
  Json list = Json::array();
  for (const PackedFrame& frame : frames) list.push_back(entry(frame));
  return list;
}

Json run_json(const RunData& run, const PageRun& page) {
  return {{"name", page.name},
          {"title", run.facts.title},
          {"case_file", run.facts.case_file},
          {"case_text", run.facts.case_text},
          {"isQuiescent", run.facts.is_quiescent()},
          {"end", run.facts.dimensionless("end", "time.end")},
          {"tables", Json::array()},
          {"frames", entries(page.frames)},
          {"cuts", entries(page.cuts)},
          {"notes", page.notes}};
}

std::string text_of(const Json& page) {
  return page.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void add_frames(DrawingData& data, const std::string& prefix,
                const std::vector<PackedFrame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i)
    data.texts.emplace_back(fmt::format("{}{}", prefix, i), base64(frames[i].bytes));
}

}  // namespace

std::vector<MeshCut> load_cuts(const fs::path& path) {
  const io::VolumeFrame mesh = io::read_vtu(path);
  return {cut_through_drops(mesh, 2), cut_through_drops(mesh, 1)};
}

PageRun page_run(RunData& run, const PageBudget& budget) {
  PageRun page;
  page.name = fs::absolute(run.folder / ".").parent_path().filename().string();
  pack_surfaces(page, run, budget);
  pack_cuts(page, run, budget);
  return page;
}

std::string entry_json(const PackedFrame& frame) { return entry(frame).dump(); }

PageRun picture_run(RunData& run, std::span<const io::PvdEntry> frames,
                    std::span<const io::PvdEntry> volume_frames) {
  PageRun page;
  page.frames = load_all(run, frames, [](const fs::path& path, double t) {
    return packed_surface(load_surface(path, t));
  });
  page.cuts = load_all(run, volume_frames, [](const fs::path& path, double t) {
    return packed_cuts(t, load_cuts(path));
  });
  return page;
}

std::string data_elements(const DrawingData& data) {
  // In a script "</script" and "<!--" mean something to HTML; in JSON only texts have a "<".
  std::string text;
  for (const char c : data.page) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  std::string elements =
      "<script type=\"application/json\" id=\"page-data\">" + text + "</script>\n";
  for (const auto& [id, bytes] : data.texts)
    elements += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, bytes);
  return elements;
}

DrawingData live_drawing_data(const RunData& run, std::string_view id) {
  return {text_of({{"kind", "live"}, {"id", id}, {"runs", Json::array({run_json(run, {})})}})};
}

DrawingData study_drawing_data(std::string_view plots, std::string_view shapes,
                               const std::vector<PackedFrame>& frames) {
  const Json run{{"name", ""},
                 {"tables", Json::array()},
                 {"frames", entries(frames)},
                 {"cuts", Json::array()}};
  DrawingData data{text_of({{"kind", "study"},
                            {"plots", Json::parse(plots)},
                            {"shapes", Json::parse(shapes)},
                            {"runs", Json::array({run})}})};
  add_frames(data, "run0-frame", frames);
  return data;
}

DrawingData drawing_data(std::string_view kind, std::span<const RunData> runs,
                         std::span<PageRun> pages, const PageBudget& budget) {
  DrawingData data;
  Json list = Json::array();
  MENISCUS_ASSERT(runs.size() == pages.size(), "{} pages of {} runs", pages.size(), runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::string prefix = fmt::format("run{}-", r);
    PageRun& page = pages[r];
    Json tables = Json::array();
    for (const io::RunTableFile& table : io::RunFiles::tables) {
      const fs::path file = runs[r].folder / table.file;
      if (!fs::exists(file)) continue;
      tables.push_back(table.name);
      // Each of the two long tables may take half of the run's budget for tables.
      data.texts.emplace_back(prefix + table.name,
                              table_text(page, table, file, budget.tables / runs.size() / 2));
    }
    add_frames(data, prefix + "frame", page.frames);
    add_frames(data, prefix + "cut", page.cuts);
    Json entry = run_json(runs[r], page);
    entry["tables"] = tables;
    list.push_back(entry);
  }
  data.page = text_of({{"kind", kind}, {"runs", list}});
  return data;
}

}  // namespace meniscus::report
