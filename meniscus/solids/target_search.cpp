#include "meniscus/solids/target_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_distance.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/solids/tessellate.hpp"
#include "meniscus/surface/sizing.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {
namespace {

using By = RemeshTarget::By;

/// A surface that does not flow needs its springs no nearer to rest: angles gain nothing by it.
constexpr double kSpringTolerance = 0.01;
constexpr int kMaxSweeps = 60;  // a sweep collapses about a fifth of the vertices: 1e6 → 10
/// Bands of the targets, in which the search ends. Counts scatter by a percent (the remesher's own
/// band).
constexpr double kNodesBand = 0.02, kEdgeBand = 0.01, kChordalBand = 0.1, kChordalAim = 0.9;
constexpr double kOtherSetting = 0.9;  // of the one that failed; the next passes correct for it
constexpr double kGain = 0.8;       // a pass that leaves more of the miss than that gained little
constexpr double kOwnShare = 0.02;  // of the tessellated smooth surface's own chordal error
constexpr double kFlat = 1e-9;      // 1/R: less curvature than this is none

}  // namespace

const char* option_name(RemeshTarget::By by) {
  switch (by) {
    case By::nodes:
      return "nodes";
    case By::edge_length:
      return "edge-length";
    case By::chordal_error:
      return "chordal-error";
  }
  return "";
}

void require_affordable(const RemeshTarget& target, double num_vertices) {
  if (num_vertices > kMostVertices)
    reject_input("--{} is too fine: it would take {:.2g} vertices; at most {:.0g} are made",
                 option_name(target.by), num_vertices, kMostVertices);
}

double band(RemeshTarget::By by) {
  if (by == By::nodes) return kNodesBand;
  return by == By::edge_length ? kEdgeBand : kChordalBand;
}

double next_setting(double setting, double measure, double last_setting, double last_measure,
                    double aim) {
  MENISCUS_ASSERT(setting > 0.0 && aim > 0.0, "{} {}", setting, aim);
  double slope = 1.0;
  if (last_setting > 0.0 && last_setting != setting)
    slope =
        std::clamp(std::log(measure / last_measure) / std::log(setting / last_setting), 0.1, 1.5);
  return setting * std::clamp(std::pow(aim / measure, 1.0 / slope), 0.05, 20.0);
}

TargetSearch::TargetSearch(std::vector<Piece> pieces, const RemeshTarget& target, double rough_edge,
                           int most_failures)
    : pieces_(std::move(pieces)),
      target_(target),
      rough_edge_(rough_edge),
      most_failures_(most_failures) {
  MENISCUS_ASSERT(!pieces_.empty() && most_failures > 0, "{} pieces, {} failures", pieces_.size(),
                  most_failures);
  if (target.by == By::chordal_error) build_references();
}

Found TargetSearch::run() const {
  Found best;
  TargetReport& report = best.report;
  int passes_since_best = 0, failures = 0;
  double setting = first_setting(), last_setting = 0.0, last_measure = 0.0;
  const double aim = target_.by == By::chordal_error ? kChordalAim * target_.value : target_.value;
  while (report.passes < kMostPasses) {
    ++report.passes;
    std::vector<SurfaceMesh> remeshed;
    if (auto fault = remesh_all(setting, remeshed)) {
      report.fault = std::move(fault);
      if (++failures == most_failures_) break;
      setting *= kOtherSetting;  // rough surfaces fail at one size and not at another near it
      continue;
    }
    const double measure = measure_of(remeshed);
    const double miss = std::abs(std::log(measure / aim));
    ++passes_since_best;
    if (miss < kGain * best.miss) passes_since_best = 0;
    if (miss < best.miss) {
      best.miss = miss;
      best.pieces = std::move(remeshed);
      report.reached = measure;
      report.is_met = miss <= band(target_.by);
    }
    const bool is_stuck = target_.by != By::nodes && passes_since_best == 3;
    if (miss <= band(target_.by) || measure == last_measure || is_stuck) break;
    const double next = next_setting(setting, measure, last_setting, last_measure, aim);
    last_setting = setting;
    last_measure = measure;
    setting = next;
  }
  if (!best.pieces.empty())
    report.fault.reset();
  else if (!report.fault)
    report.fault = Fault{FaultKind::not_converged, "no triangulation could be measured"};
  return best;
}

void TargetSearch::build_references() {
  double num_vertices = 0.0;
  for (Piece& piece : pieces_) {
    const SurfaceTopology topology(piece.mesh);
    const SmoothSurface surface(piece.mesh, topology);
    Reference reference{tessellation(piece.mesh, surface, kOwnShare * target_.value),
                        std::make_unique<SurfaceTree>(piece.mesh),
                        VertexField<double>(piece.mesh.num_vertices()),
                        VertexField<double>(piece.mesh.num_vertices())};
    const VertexField<double> areas = vertex_areas(piece.mesh);
    for (const VertexId v : piece.mesh.x.ids()) {
      const VertexCurvature& c = surface.vertex_curvature()[v];
      const double largest = std::max({std::abs(c.k1), std::abs(c.k2), kFlat});
      reference.unit_length[v] = std::sqrt(6.0 / largest);
      reference.largest_length[v] = 1.0 / largest;
      const double edge =
          std::max(std::sqrt(target_.value) * reference.unit_length[v], target_.edge_floor);
      num_vertices += areas[v] * density_of_length(edge);
    }
    // Flat faces that stand for a smooth surface enclose less than it does.
    if (!piece.is_rough) piece.volume = enclosed_volume(reference.tessellation);
    references_.push_back(std::move(reference));
  }
  require_affordable(target_, num_vertices);
}

/// The setting that is varied until the target is met: C0, the length asked for, the chordal error
/// asked for.
double TargetSearch::first_setting() const {
  if (target_.by == By::nodes)
    return target_.value / (4.0 * std::numbers::pi * static_cast<double>(pieces_.size()));
  return target_.value;
}

RemeshOptions TargetSearch::options(std::size_t i, double setting) const {
  RemeshOptions options = sound_remeshing(setting, std::max(target_.edge_floor, rough_edge_));
  options.volume = pieces_[i].volume;
  options.gradation = target_.gradation;
  options.min_vertices = RemeshTarget::kFewestNodes;
  options.max_sweeps = kMaxSweeps;
  options.spring_tolerance = kSpringTolerance;
  switch (target_.by) {
    case By::nodes:
      break;
    case By::edge_length:
      options.C0 = 1.0;
      options.edge_floor = setting;
      options.edge_ceiling = setting * (1.0 + 1e-9);
      options.min_vertices = 4;
      break;
    case By::chordal_error:
      options.C0 = 1e-9;  // the curvature law is not to speak
      options.size_bound = chordal_lengths(i, setting);
      break;
  }
  return options;
}

/// Rest lengths that give the chordal error `setting`, by the curvature at the nearest point of the
/// piece.
std::function<double(const Vec3&)> TargetSearch::chordal_lengths(std::size_t i,
                                                                 double setting) const {
  return [&reference = references_[i], &mesh = pieces_[i].mesh,
          root = std::sqrt(setting)](const Vec3& x) {
    const SurfaceTree::Hit hit = reference.tree->closest(x);
    double length = 0.0;
    for (int k = 0; k < 3; ++k) {
      const VertexId v = mesh.faces[hit.face][static_cast<std::size_t>(k)];
      length +=
          hit.weights[k] * std::min(root * reference.unit_length[v], reference.largest_length[v]);
    }
    return length;
  };
}

/// Remeshes a copy of every piece, up to the first that cannot be.
std::optional<Fault> TargetSearch::remesh_all(double setting,
                                              std::vector<SurfaceMesh>& remeshed) const {
  MENISCUS_ASSERT(remeshed.empty(), "{}", remeshed.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    remeshed.push_back(pieces_[i].mesh);
    RemeshReport report = remesh(remeshed.back(), options(i, setting));
    if (report.fault) return std::move(report.fault);
  }
  return {};
}

double TargetSearch::measure_of(const std::vector<SurfaceMesh>& remeshed) const {
  MENISCUS_ASSERT(remeshed.size() == pieces_.size(), "{} of {} pieces", remeshed.size(),
                  pieces_.size());
  if (target_.by == By::nodes) return joined_surface(remeshed).num_vertices();
  if (target_.by == By::edge_length) return mean_edge(joined_surface(remeshed));
  double largest = 0.0;
  for (std::size_t i = 0; i < remeshed.size(); ++i) {
    const SampledDistance d =
        directed_distance(remeshed[i], references_[i].tessellation, {.relative_error = kOwnShare});
    largest = std::max(largest, d.distance + d.error);
  }
  return largest;
}

}  // namespace meniscus
