#include "meniscus/evolve/stop_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

constexpr std::array kWords{"time", "steady", "broken", "length", "patch"};

constexpr const char *kTimes = "evolution/lengths/t", *kDrops = "evolution/lengths/drop",
                     *kLengths = "evolution/lengths/L";

/// What a window's bounds may be off by, in round-off of the times.
constexpr double kTimeRoundOff = 1e-12;

bool are_same_drops(std::span<const DropLength> a, std::span<const DropLength> b) {
  return std::ranges::equal(a, b, {}, &DropLength::drop, &DropLength::drop);
}

std::vector<DropLength> lengths_of(std::span<const DropRow> rows) {
  std::vector<DropLength> lengths;
  lengths.reserve(rows.size());
  for (const DropRow& row : rows) lengths.push_back({row.drop, row.shape.L});
  return lengths;
}

std::string words_for(const TopologyEvent& event) {
  return event.kind == EventKind::breakup ? "a drop broke up" : "drops merged";
}

}  // namespace

const char* word_for(Ending ending) { return kWords.at(static_cast<std::size_t>(ending)); }

void LengthRates::add(double t, std::vector<DropLength> drops) {
  if (!samples_.empty() && !are_same_drops(samples_.back().drops, drops)) samples_.clear();
  MENISCUS_ASSERT(samples_.empty() || t > samples_.back().t, "a row at {:g} after {:g}", t,
                  samples_.back().t);
  samples_.push_back({t, std::move(drops)});
  // The sample at or before the start of the window before the last one stays.
  const double start = t - 2.0 * kRateWindow;
  while (samples_.size() > 2 && samples_[1].t <= start) samples_.pop_front();
}

void LengthRates::save(Archive& archive) const {
  std::vector<double>&t = archive.reals[kTimes], &L = archive.reals[kLengths];
  std::vector<std::int64_t>& drops = archive.integers[kDrops];
  if (samples_.empty()) return;
  for (const DropLength& each : samples_.back().drops) drops.push_back(each.drop);
  for (const Sample& sample : samples_) {
    t.push_back(sample.t);
    for (const DropLength& each : sample.drops) L.push_back(each.L);
  }
}

void LengthRates::load(const Archive& archive) {
  const auto t = archive.reals.find(kTimes), L = archive.reals.find(kLengths);
  const auto drops = archive.integers.find(kDrops);
  samples_.clear();
  if (t == archive.reals.end()) return;
  if (L == archive.reals.end() || drops == archive.integers.end() ||
      L->second.size() != t->second.size() * drops->second.size() ||
      std::ranges::adjacent_find(t->second, std::greater_equal()) != t->second.end())
    reject_input("checkpoint entries \"evolution/lengths\" do not fit together");
  for (std::size_t i = 0, at = 0; i < t->second.size(); ++i) {
    Sample& sample = samples_.emplace_back(Sample{t->second[i], {}});
    for (const std::int64_t drop : drops->second)
      sample.drops.push_back({static_cast<int>(drop), L->second[at++]});
  }
}

double LengthRates::length_at(double t, std::size_t drop) const {
  std::size_t after = 0;
  while (after + 1 < samples_.size() && samples_[after].t < t) ++after;
  const double L = samples_[after].drops[drop].L;
  if (after == 0 || samples_[after].t <= t) return L;
  const Sample& before = samples_[after - 1];
  const double share = (t - before.t) / (samples_[after].t - before.t);
  return before.drops[drop].L + share * (L - before.drops[drop].L);
}

LengthRates::Extent LengthRates::extent(double from, double to, std::size_t drop) const {
  const double first = length_at(from, drop), last = length_at(to, drop);
  Extent extent{std::min(first, last), std::max(first, last)};
  for (const Sample& sample : samples_) {
    if (sample.t < from || sample.t > to) continue;
    extent.least = std::min(extent.least, sample.drops[drop].L);
    extent.largest = std::max(extent.largest, sample.drops[drop].L);
  }
  return extent;
}

bool LengthRates::are_steady(double bound) const {
  if (samples_.empty()) return false;
  const double now = samples_.back().t;
  if (now - samples_.front().t < 2.0 * kRateWindow * (1.0 - kTimeRoundOff)) return false;
  for (std::size_t drop = 0; drop < samples_.back().drops.size(); ++drop) {
    const Extent last = extent(now - kRateWindow, now, drop);
    const Extent before = extent(now - 2.0 * kRateWindow, now - kRateWindow, drop);
    const double change = last.largest - last.least;
    if (!(change < bound * kRateWindow) || change > before.largest - before.least) return false;
  }
  return true;
}

bool LengthRates::is_runaway(double length) const {
  if (samples_.size() < 3) return false;
  const double now = samples_.back().t;
  const double window = std::min(kRateWindow, 0.5 * (now - samples_.front().t));
  for (std::size_t drop = 0; drop < samples_.back().drops.size(); ++drop) {
    const double L = samples_.back().drops[drop].L, middle = length_at(now - window, drop);
    const double growth = L - middle, before = middle - length_at(now - 2.0 * window, drop);
    if (L > length && growth > kLeastGrowth * L * window && growth > before) return true;
  }
  return false;
}

std::optional<RunEnd> StopJudge::judge(double t, std::span<const DropRow> drops,
                                       std::span<const TopologyEvent> events, const Scene& scene,
                                       const StepAhead& next) {
  rates_.add(t, lengths_of(drops));
  if (rules_.is_broken_by_event && !events.empty())
    return RunEnd{Ending::broken, words_for(events.front())};
  if (rules_.broken_length && rates_.is_runaway(*rules_.broken_length))
    return RunEnd{Ending::broken, fmt::format("a drop's L is beyond {:g} R0 and grows ever faster",
                                              *rules_.broken_length)};
  const auto longest =
      std::ranges::max_element(drops, {}, [](const DropRow& row) { return row.shape.L; });
  if (rules_.length && longest != drops.end() && longest->shape.L > *rules_.length)
    return RunEnd{Ending::length,
                  fmt::format("L of drop {} is beyond {:g} R0", longest->drop, *rules_.length)};
  if (rules_.is_ended_by_patch)
    if (const auto contact = find_patch_contact(scene, next, rules_.patch_gap))
      return RunEnd{Ending::patch, fmt::format("drop {} came to the open patch \"{}\"",
                                               contact->drop, contact->patch)};
  if (rules_.steady_rate && rates_.are_steady(*rules_.steady_rate))
    return RunEnd{Ending::steady,
                  fmt::format("steady: L changes by less than {:g} per 1/G", *rules_.steady_rate)};
  return std::nullopt;
}

std::optional<PatchContact> find_patch_contact(const Scene& scene, const StepAhead& next,
                                               std::optional<double> gap) {
  if (!has_open_patch(scene)) return std::nullopt;
  const SurfaceTree wall(scene.boundary.mesh);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const SurfaceMesh& mesh = scene.interfaces[i].mesh;
    const VertexField<double> edges = mean_edges(mesh);
    for (const VertexId v : mesh.x.ids()) {
      const Vec3 way = next.motion.empty() ? Vec3::Zero() : Vec3(next.dt * next.motion[i][v]);
      const double near = gap.value_or(kPatchGapInEdges * edges[v]);
      const SurfaceTree::Hit hit = wall.closest(mesh.x[v], near + way.norm());
      if (!hit.face.is_valid()) continue;
      const Patch& patch = scene.boundary.patches[scene.boundary.patch[hit.face]];
      if (!std::holds_alternative<ImposedTraction>(patch.condition)) continue;
      const Vec3 out = face_area_vector(scene.boundary.mesh, hit.face).normalized();
      if (hit.distance - std::max(0.0, way.dot(out)) < near)
        return PatchContact{scene.interfaces[i].drop, patch.name};
    }
  }
  return std::nullopt;
}

}  // namespace meniscus
