#include "meniscus/app/run_directory.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/app/frames.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/atomic_file.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

constexpr int kCheckpointsKept = 2;

const std::vector<std::string> kHistoryColumns{"step",
                                               "t",
                                               "dt",
                                               "drops",
                                               "surface_nodes",
                                               "nodes",
                                               "tetrahedra",
                                               "min_gap",
                                               "min_dihedral_deg",
                                               "linear_iterations",
                                               "power_in",
                                               "dissipation",
                                               "surface_rate",
                                               "power_residual",
                                               "stress_xx",
                                               "stress_yy",
                                               "stress_zz",
                                               "stress_xy",
                                               "stress_xz",
                                               "stress_yz",
                                               "N1",
                                               "N2"};
const std::vector<std::string> kDropColumns{"step",
                                            "t",
                                            "drop",
                                            "parent",
                                            "volume",
                                            "volume_drift",
                                            "volume_correction",
                                            "area",
                                            "x",
                                            "y",
                                            "z",
                                            "L",
                                            "B",
                                            "W",
                                            "D",
                                            "angle_deg",
                                            "extent_x",
                                            "H_max",
                                            "D_inertia",
                                            "neck_radius"};
const std::vector<std::string> kEventColumns{"step",
                                             "t",
                                             "kind",
                                             "x",
                                             "y",
                                             "z",
                                             "parents",
                                             "children",
                                             "volume_before",
                                             "volume_after",
                                             "area_before",
                                             "area_after",
                                             "energy_before",
                                             "energy_after",
                                             "neck_radius",
                                             "gap"};

std::vector<std::string> timing_columns() {
  std::vector<std::string> columns{"step", "t"};
  for (std::string phase : timed_phases()) {
    std::ranges::replace(phase, ' ', '_');
    columns.push_back(phase);
  }
  return columns;
}

template <class T>
io::Cell cell(const std::optional<T>& value) {
  return value ? io::Cell(*value) : io::Cell();
}

/// Step of "checkpoint-<step>.h5", if a file is one.
std::optional<std::int64_t> checkpoint_step(const fs::path& file) {
  const std::string name = file.filename().string(), prefix = "checkpoint-", suffix = ".h5";
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
  std::int64_t step = 0;
  const char *begin = name.data() + prefix.size(), *end = name.data() + name.size() - suffix.size();
  const auto [stopped, error] = std::from_chars(begin, end, step);
  return error == std::errc() && stopped == end ? std::optional(step) : std::nullopt;
}

/// Checkpoints of a folder in rising order of step.
std::vector<std::pair<std::int64_t, fs::path>> checkpoints(const fs::path& path) {
  std::vector<std::pair<std::int64_t, fs::path>> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path, ignored))
    if (const auto step = checkpoint_step(entry.path())) found.emplace_back(*step, entry.path());
  std::ranges::sort(found);
  return found;
}

std::vector<io::PvdEntry> frames_before(const fs::path& pvd, double t) {
  if (!fs::exists(pvd)) return {};
  std::vector<io::PvdEntry> entries = io::read_pvd(pvd);
  std::erase_if(entries, [&](const io::PvdEntry& entry) { return entry.t >= t; });
  return entries;
}

/// Those of the events in a table, and the ones before: their checkpoints stay.
std::set<std::int64_t> steps_around_events(const fs::path& events) {
  std::set<std::int64_t> steps;
  if (!fs::exists(events)) return steps;
  for (const double step : io::read_table(events).column("step")) {
    steps.insert(std::llround(step));
    steps.insert(std::llround(step) - 1);
  }
  return steps;
}

std::string joined_ids(const std::vector<int>& ids) {
  return fmt::format("{}", fmt::join(ids, ";"));
}

io::TableWriter table(const fs::path& path, const std::vector<std::string>& columns,
                      std::optional<std::int64_t> first_step) {
  return first_step && fs::exists(path) ? io::TableWriter(path, columns, *first_step)
                                        : io::TableWriter(path, columns);
}

}  // namespace

const std::vector<std::string>& timed_phases() {
  static const std::vector<std::string> phases{"remesh surface", "tetrahedralize",  "assemble",
                                               "solve",          "move mesh",       "diagnostics",
                                               "output",         "move interfaces", "topology"};
  return phases;
}

RunDirectory::RunDirectory(FolderLock lock, fs::path path, std::optional<std::int64_t> first_step)
    : lock_(std::move(lock)),
      path_(std::move(path)),
      kept_steps_(first_step ? steps_around_events(path_ / "events.csv")
                             : std::set<std::int64_t>{}),
      history_(table(path_ / "history.csv", kHistoryColumns, first_step)),
      drops_(table(path_ / "drops.csv", kDropColumns, first_step)),
      events_(table(path_ / "events.csv", kEventColumns, first_step)),
      timing_(table(path_ / "timing.csv", timing_columns(), first_step)) {}

RunDirectory RunDirectory::create(const fs::path& path, bool overwrite) {
  require_usable(path, overwrite);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) reject_input("output folder {} cannot be made: {}", path.string(), error.message());
  FolderLock lock(path);
  if (holds_run(path)) remove_run(path);
  try {
    return RunDirectory(std::move(lock), path, std::nullopt);
  } catch (const std::exception&) {
    remove_unbegun_run(path);
    throw;
  }
}

RunDirectory RunDirectory::take_up(const fs::path& path, std::int64_t first_step, double t) {
  RunDirectory directory(FolderLock(path), path, first_step);
  directory.surface_frames_ = frames_before(path / "surface.pvd", t);
  directory.volume_frames_ = frames_before(path / "volume.pvd", t);
  return directory;
}

void RunDirectory::add_rows(const HistoryRow& h, const std::vector<DropRow>& drops) {
  for (const DropRow& row : drops) {
    const DropShape& s = row.shape;
    drops_.add({h.step,
                h.t,
                std::int64_t{row.drop},
                row.parent < 0 ? io::Cell() : io::Cell(std::int64_t{row.parent}),
                s.volume,
                row.volume_drift,
                row.volume_correction,
                s.area,
                s.centroid.x(),
                s.centroid.y(),
                s.centroid.z(),
                s.L,
                s.B,
                s.W,
                s.D,
                cell(s.angle_deg),
                s.extent_x,
                s.H_max,
                s.D_inertia,
                cell(row.neck_radius)});
  }
  const auto stress = [&h](int i, int j) {
    return h.stress ? io::Cell((*h.stress)(i, j)) : io::Cell();
  };
  const auto difference = [&h](int i, int j) {
    return h.stress ? io::Cell((*h.stress)(i, i) - (*h.stress)(j, j)) : io::Cell();
  };
  history_.add({h.step,
                h.t,
                h.dt,
                std::int64_t{h.drops},
                h.surface_nodes,
                cell(h.nodes),
                cell(h.tetrahedra),
                cell(h.min_gap),
                cell(h.min_dihedral_deg),
                std::int64_t{h.linear_iterations},
                cell(h.power_in),
                cell(h.dissipation),
                h.surface_rate,
                cell(h.power_residual()),
                stress(0, 0),
                stress(1, 1),
                stress(2, 2),
                stress(0, 1),
                stress(0, 2),
                stress(1, 2),
                difference(0, 1),
                difference(1, 2)});
}

void RunDirectory::add_events(std::int64_t step, double t,
                              const std::vector<TopologyEvent>& events) {
  for (const TopologyEvent& e : events)
    events_.add({step, t, e.kind == EventKind::breakup ? "breakup" : "coalescence", e.place.x(),
                 e.place.y(), e.place.z(), joined_ids(e.parents), joined_ids(e.children),
                 e.volume_before, e.volume_after, e.area_before, e.area_after, e.energy_before,
                 e.energy_after, cell(e.neck_radius), cell(e.gap)});
  if (!events.empty()) kept_steps_.insert({step - 1, step});
}

void RunDirectory::add_timing(std::int64_t step, double t,
                              const std::vector<std::pair<std::string, double>>& seconds) {
  std::vector<io::Cell> row{step, t};
  for (const std::string& phase : timed_phases()) {
    const auto found = std::ranges::find(seconds, phase, &std::pair<std::string, double>::first);
    row.emplace_back(found == seconds.end() ? 0.0 : found->second);
  }
  timing_.add(row);
}

void RunDirectory::add_surface_frame(const Evolution& evolution) {
  fs::create_directories(path_ / "surface");
  const std::string file = fmt::format("surface/surface-{:06}.vtp", evolution.step());
  write_surface_frame(path_ / file, evolution);
  surface_frames_.push_back({evolution.t(), file});
  io::write_pvd(path_ / "surface.pvd", surface_frames_);
}

void RunDirectory::add_volume_frame(const Evolution& evolution) {
  if (!evolution.state().mesh) return;
  fs::create_directories(path_ / "volume");
  const std::string file = fmt::format("volume/volume-{:06}.vtu", evolution.step());
  write_volume_frame(path_ / file, evolution);
  volume_frames_.push_back({evolution.t(), file});
  io::write_pvd(path_ / "volume.pvd", volume_frames_);
}

void RunDirectory::write_checkpoint(const Archive& archive, std::int64_t step) {
  io::write_archive(path_ / fmt::format("checkpoint-{:06}.h5", step), archive);
  const auto all = checkpoints(path_);
  for (std::size_t i = 0; i + kCheckpointsKept < all.size(); ++i)
    if (!kept_steps_.contains(all[i].first)) fs::remove(all[i].second);
}

void RunDirectory::write_text(const std::string& name, const std::string& text) const {
  io::write_file(path_ / name, text);
}

void require_usable(const fs::path& path, bool overwrite) {
  std::error_code ignored;
  for (fs::path part = fs::absolute(path); part.has_relative_path(); part = part.parent_path()) {
    if (!fs::exists(part, ignored)) continue;
    if (!fs::is_directory(part, ignored))
      reject_input("output folder {}: {} is a file", path.string(), part.string());
    break;
  }
  if (holds_run(path) && !overwrite)
    reject_input("output folder {} holds a run already; give --overwrite or another -o",
                 path.string());
}

void remove_run(const fs::path& path) {
  for (const char* name : {"history.csv", "drops.csv", "events.csv", "timing.csv", "run.json",
                           "report.html", "surface.pvd", "volume.pvd", "surface", "volume"})
    fs::remove_all(path / name);
  for (const auto& [step, file] : checkpoints(path)) fs::remove(file);
}

void remove_unbegun_run(const fs::path& path) {
  if (checkpoints(path).empty()) remove_run(path);
}

bool holds_run(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return false;
  return fs::exists(path / "history.csv", error) || !checkpoints(path).empty();
}

fs::path newest_checkpoint(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) reject_input("{} is not the folder of a run", path.string());
  const auto all = checkpoints(path);
  if (all.empty()) reject_input("{} holds no checkpoint to go on from", path.string());
  return all.back().second;
}

}  // namespace meniscus
