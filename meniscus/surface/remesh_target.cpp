#include "meniscus/surface/remesh_target.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_distance.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/diffused.hpp"
#include "meniscus/surface/even_out.hpp"
#include "meniscus/surface/foreseen_vertices.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/sizing.hpp"
#include "meniscus/surface/smooth_surface.hpp"
#include "meniscus/surface/tessellate.hpp"

namespace meniscus {
namespace {

using By = RemeshTarget::By;

constexpr int kMaxPasses = 10;  // one to three are usual; more where a floor bends the law
/// A surface that does not flow needs its springs no nearer to rest: angles gain nothing by it.
constexpr double kEquilibrium = 0.01;
constexpr int kMaxSweeps = 60;  // a sweep collapses about a fifth of the vertices: 1e6 → 10
/// Of each target: where the search ends. Counts scatter by a percent (the remesher's own band).
constexpr double kNodesBand = 0.02, kEdgeBand = 0.01, kChordalBand = 0.1, kChordalAim = 0.9;
constexpr int kMaxFailures = 5;
constexpr double kOtherKnob = 0.9;  // of the one that failed; the next passes correct for it
constexpr double kGain = 0.8;       // a pass that leaves more of the miss than that gained little
constexpr double kOwnShare = 0.02;  // of the tessellated smooth surface's own chordal error
constexpr double kRoughEdge = 0.5;  // of the target's mean edge
constexpr double kRoughChord =
    2.0;  // of the chordal error: creases are rounded by about half of it
/// Lengths that rough pieces are smoothed over, in edges of the rough surface, the least first:
/// from none to where the sharpest edges have become round enough to be fitted.
constexpr std::array<double, 6> kRoundings{0.0, 0.5, 0.7, 1.0, 1.4, 2.0};
constexpr double kMostLost = 0.05;  // of a piece's volume, with what is thinner than the rounding
/// Vertices on creases over those that the area takes, above which a surface is a needle: that of a
/// bar, one edge thick, is near 1. Beyond, CGAL makes fans of triangles without end.
constexpr double kMostOnCreases = 2.5;
constexpr double kFlat = 1e-9;  // 1/R: less curvature than this is none

const char* option_name(By by) {
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

double equivalent_radius(double volume) {
  return std::cbrt(3.0 * std::abs(volume) / (4.0 * std::numbers::pi));
}

/// The surface in units of its equivalent radius, its middle at the origin.
struct Frame {
  Vec3 center;
  double radius;
  explicit Frame(const SurfaceMesh& mesh)
      : center(mean_vertex(mesh)), radius(equivalent_radius(enclosed_volume(mesh))) {}
  void enter(SurfaceMesh& mesh) const {
    for (Vec3& x : mesh.x) x = (x - center) / radius;
  }
  void leave(SurfaceMesh& mesh) const {
    for (Vec3& x : mesh.x) x = center + radius * x;
  }
};

/// One piece as it came (evened out if it was rough), turned so that its volume is positive.
struct Piece {
  SurfaceMesh mesh;
  double volume;
  bool is_cavity;
  bool is_rough = false;
};

/// Throws InvalidInput if the target would take too many vertices.
void require_affordable(const RemeshTarget& target, double num_vertices) {
  if (num_vertices > kMostVertices)
    reject_input("--{} is too fine: it would take {:.2g} vertices; at most {:.0g} are made",
                 option_name(target.by), num_vertices, kMostVertices);
}

/// The length of even triangles on a rough surface of the given area.
double rough_edge_length(const RemeshTarget& target, double area) {
  double edge = kRoughChord * target.value;
  if (target.by == By::nodes) edge = kRoughEdge * length_of_density(target.value / area);
  if (target.by == By::edge_length) edge = kRoughEdge * target.value;
  edge = std::max(edge, target.edge_floor);
  require_affordable(target, area * density_of_length(edge));
  return edge;
}

/// Throws InvalidInput where creases alone would take many times the vertices that the area does.
void require_thickness(const SurfaceMesh& mesh, const RemeshTarget& target) {
  const SurfaceTopology topology(mesh);
  if (!is_rough(mesh, topology)) return;
  const double area = surface_area(mesh), edge = rough_edge_length(target, area);
  const Creases found = creases(mesh, topology, edge);
  const double most = std::min(kMostOnCreases * area * density_of_length(edge), kMostVertices);
  if (found.pieces <= most) return;
  const Vec3 &a = mesh.x[found.longest.a], &b = mesh.x[found.longest.b];
  reject_input(
      "--{} {:g}: the surface is too thin: in triangles of {:.3g} its creases would take {:.2g} "
      "vertices; at most {:.2g} are made; the longest, of {:.3g}, goes from ({:.6g}, {:.6g}, "
      "{:.6g}) to ({:.6g}, {:.6g}, {:.6g})",
      option_name(target.by), target.value, edge, found.pieces, most, (b - a).norm(), a.x(), a.y(),
      a.z(), b.x(), b.y(), b.z());
}

double band(By by) {
  if (by == By::nodes) return kNodesBand;
  return by == By::edge_length ? kEdgeBand : kChordalBand;
}

/// The next knob: first as if the measure were proportional to it, then by the secant of the two
/// passes before in logarithms (floors and gradation bend the law; its slope stays in bounds).
double corrected(double knob, double measure, double last_knob, double last_measure, double aim) {
  double slope = 1.0;
  if (last_knob > 0.0 && last_knob != knob)
    slope = std::clamp(std::log(measure / last_measure) / std::log(knob / last_knob), 0.1, 1.5);
  return knob * std::clamp(std::pow(aim / measure, 1.0 / slope), 0.05, 20.0);
}

/// The best result of a search: no pieces, and the failure reported, if no pass succeeded.
struct Found {
  std::vector<SurfaceMesh> pieces;
  double miss = std::numeric_limits<double>::infinity();  ///< |ln(measure/target)|
  TargetReport report;
};

/// Remeshes pieces to a target, in the units of the frame.
class TargetSearch {
 public:
  /// Ends at the `most_failures`-th pass that fails.
  TargetSearch(std::vector<Piece> pieces, const RemeshTarget& target, double rough_edge,
               int most_failures)
      : pieces_(std::move(pieces)),
        target_(target),
        rough_edge_(rough_edge),
        most_failures_(most_failures) {
    if (target.by == By::chordal_error) build_references();
  }

  [[nodiscard]] Found run() const {
    Found best;
    TargetReport& report = best.report;
    int passes_since_best = 0, failures = 0;
    double knob = first_knob(), last_knob = 0.0, last_measure = 0.0;
    const double aim =
        target_.by == By::chordal_error ? kChordalAim * target_.value : target_.value;
    while (report.passes < kMaxPasses) {
      ++report.passes;
      std::vector<SurfaceMesh> remeshed;
      std::string failure = pass(knob, remeshed);
      if (!failure.empty()) {  // rough surfaces fail at one size and not at another near it
        if (++failures == most_failures_) {
          report.failure = std::move(failure);
          break;
        }
        knob *= kOtherKnob;
        continue;
      }
      const double measure = measured(remeshed);
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
      const double next = corrected(knob, measure, last_knob, last_measure, aim);
      last_knob = knob;
      last_measure = measure;
      knob = next;
    }
    return best;
  }

 private:
  struct Reference {
    SurfaceMesh tessellated;
    std::unique_ptr<SurfaceTree> tree;   // of the piece
    VertexField<double> unit_length;     // l0 for a chordal error of 1
    VertexField<double> largest_length;  // 1/max|k|
  };

  void build_references() {
    double num_vertices = 0.0;
    for (Piece& piece : pieces_) {
      const SurfaceTopology topology(piece.mesh);
      const SmoothSurface surface(piece.mesh, topology);
      Reference reference{tessellated(piece.mesh, surface, kOwnShare * target_.value),
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
      if (!piece.is_rough) piece.volume = enclosed_volume(reference.tessellated);
      references_.push_back(std::move(reference));
    }
    require_affordable(target_, num_vertices);
  }

  /// What is turned until the target is met: C0, the length asked for, the chordal error asked for.
  [[nodiscard]] double first_knob() const {
    if (target_.by == By::nodes)
      return target_.value / (4.0 * std::numbers::pi * static_cast<double>(pieces_.size()));
    return target_.value;
  }

  [[nodiscard]] RemeshOptions options(std::size_t i, double knob) const {
    RemeshOptions options = sound_remeshing(knob, std::max(target_.edge_floor, rough_edge_));
    options.volume = pieces_[i].volume;
    options.gradation = target_.gradation;
    options.min_vertices = RemeshTarget::kFewestNodes;
    options.max_sweeps = kMaxSweeps;
    options.equilibrium = kEquilibrium;
    switch (target_.by) {
      case By::nodes:
        break;
      case By::edge_length:
        options.C0 = 1.0;
        options.edge_floor = knob;
        options.edge_ceiling = knob * (1.0 + 1e-9);
        options.min_vertices = 4;
        break;
      case By::chordal_error:
        options.C0 = 1e-9;  // the curvature law is not to speak
        options.size_bound = [&reference = references_[i], &mesh = pieces_[i].mesh,
                              root = std::sqrt(knob)](const Vec3& x) {
          const SurfaceTree::Hit hit = reference.tree->closest(x);
          double length = 0.0;
          for (int k = 0; k < 3; ++k) {
            const VertexId v = mesh.faces[hit.face][static_cast<std::size_t>(k)];
            length += hit.weights[k] *
                      std::min(root * reference.unit_length[v], reference.largest_length[v]);
          }
          return length;
        };
        break;
    }
    return options;
  }

  /// Remeshes every piece; returns why it could not.
  std::string pass(double knob, std::vector<SurfaceMesh>& remeshed) const {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      remeshed.push_back(pieces_[i].mesh);
      const RemeshReport report = remesh(remeshed.back(), options(i, knob));
      if (!report.ok) return report.failure;
    }
    return {};
  }

  [[nodiscard]] double measured(const std::vector<SurfaceMesh>& remeshed) const {
    if (target_.by == By::nodes) return joined(remeshed).num_vertices();
    if (target_.by == By::edge_length) return mean_edge(joined(remeshed));
    double largest = 0.0;
    for (std::size_t i = 0; i < remeshed.size(); ++i) {
      const SampledDistance d =
          directed_distance(remeshed[i], references_[i].tessellated, {.relative_error = kOwnShare});
      largest = std::max(largest, d.distance + d.error);
    }
    return largest;
  }

  std::vector<Piece> pieces_;
  RemeshTarget target_;
  double rough_edge_;
  int most_failures_;
  std::vector<Reference> references_;
};

/// Pieces in units of the frame; those that lie inside out in another are turned and marked.
std::vector<Piece> pieces_of(const SurfaceMesh& mesh) {
  std::vector<Piece> pieces;
  for (SurfaceMesh& piece : connected_pieces(mesh)) {
    double volume = enclosed_volume(piece);
    const bool is_cavity = volume < 0.0;
    if (is_cavity) turn_inside_out(piece);
    pieces.push_back({std::move(piece), std::abs(volume), is_cavity});
  }
  return pieces;
}

/// Gives rough pieces even triangles; returns their length, 0 if no piece was rough.
double even_out(std::vector<Piece>& pieces, const RemeshTarget& target) {
  double area = 0.0;
  for (const Piece& piece : pieces) area += surface_area(piece.mesh);
  double edge = 0.0;
  for (Piece& piece : pieces) {
    piece.is_rough = is_rough(piece.mesh, SurfaceTopology(piece.mesh));
    if (!piece.is_rough) continue;
    edge = rough_edge_length(target, area);
    piece.mesh = evened_out(piece.mesh, edge);
  }
  return edge;
}

/// Pieces whose rough ones can be smoothed over lengths, each not less than the last.
class RoughPieces {
 public:
  RoughPieces(const std::vector<Piece>& pieces, double edge) : pieces_(pieces), edge_(edge) {}

  /// None where that loses what is thinner than the length, or a hole.
  std::optional<std::vector<Piece>> smoothed(double length) {
    if (length == 0.0) return pieces_;
    std::vector<Piece> smooth = pieces_;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      if (!smooth[i].is_rough) continue;
      SurfaceMesh& mesh = smooth[i].mesh;
      const auto found = diffused_.try_emplace(i, mesh, edge_).first;
      std::optional<SurfaceMesh> round = found->second.smoothed(length, kMostLost);
      if (!round || !find_defect(*round).empty() ||
          euler_characteristic(*round) != euler_characteristic(mesh))
        return std::nullopt;
      mesh = std::move(*round);
    }
    return smooth;
  }

 private:
  const std::vector<Piece>& pieces_;
  double edge_;
  std::map<std::size_t, DiffusedSurface> diffused_;
};

/// The first of the roundings that meets the target; the one that comes nearest to it, else.
Found search_rounded(const std::vector<Piece>& pieces, const RemeshTarget& target,
                     double rough_edge) {
  RoughPieces rough(pieces, rough_edge);
  Found best;
  int passes = 0;
  for (const double rounding : kRoundings) {
    std::optional<std::vector<Piece>> smooth = rough.smoothed(rounding * rough_edge);
    if (!smooth) break;
    const int failures = rounding == kRoundings.back() ? kMaxFailures : 1;
    Found found = TargetSearch(std::move(*smooth), target, rough_edge, failures).run();
    passes += found.report.passes;
    if (found.miss < best.miss || (best.pieces.empty() && best.report.failure.empty()))
      best = std::move(found);
    if (best.report.is_met) break;
  }
  best.report.passes = passes;
  best.report.are_creases_rounded = true;
  if (best.pieces.empty())
    best.report.failure +=
        "; parts are too thin, or edges too sharp, for triangles as large as asked for";
  return best;
}

/// Pieces in even triangles on their flat faces; none where that leaves one unsound.
std::vector<SurfaceMesh> cut_evenly(const std::vector<Piece>& pieces, double edge) {
  std::vector<SurfaceMesh> even;
  for (const Piece& piece : pieces) {
    even.push_back(evened_out(piece.mesh, edge));
    restore_volume(even.back(), piece.volume);
    if (!find_defect(even.back()).empty()) return {};
  }
  return even;
}

/// What is left where no smooth surface fits: the pieces as they came, cut evenly. They have no
/// chordal error, whatever their edges are.
Found search_cut(const std::vector<Piece>& pieces, const RemeshTarget& target, double rough_edge) {
  Found best;
  best.report.are_creases_kept = true;
  if (target.by == By::chordal_error) {
    best.pieces = cut_evenly(pieces, rough_edge);
    best.report.passes = 1;
    best.report.is_met = true;
    return best;
  }
  double area = 0.0;
  for (const Piece& piece : pieces) area += surface_area(piece.mesh);
  double knob = target.value, last_knob = 0.0, last_measure = 0.0;
  while (best.report.passes < kMaxPasses && !best.report.is_met) {
    ++best.report.passes;
    const bool counts = target.by == By::nodes;
    std::vector<SurfaceMesh> even = cut_evenly(
        pieces, std::max(counts ? length_of_density(knob / area) : knob, target.edge_floor));
    if (even.empty()) break;
    const SurfaceMesh all = joined(even);
    const double measure = counts ? all.num_vertices() : mean_edge(all);
    if (measure == last_measure) break;
    const double miss = std::abs(std::log(measure / target.value));
    if (miss < best.miss) {
      best.miss = miss;
      best.pieces = std::move(even);
      best.report.reached = measure;
      best.report.is_met = miss <= band(target.by);
    }
    const double next = corrected(knob, measure, last_knob, last_measure, target.value);
    last_knob = knob;
    last_measure = measure;
    knob = next;
  }
  return best;
}

/// A surface with rough pieces: rounded, or cut evenly where that does not do.
Found search_rough(const std::vector<Piece>& given, const std::vector<Piece>& even,
                   const RemeshTarget& target, double rough_edge) {
  Found rounded = search_rounded(even, target, rough_edge);
  if (!rounded.pieces.empty()) return rounded;
  Found cut = search_cut(given, target, rough_edge);
  if (cut.pieces.empty()) return rounded;
  cut.report.passes += rounded.report.passes;
  return cut;
}

/// The target in units of the frame.
RemeshTarget scaled(RemeshTarget target, double radius) {
  if (target.by != By::nodes) target.value /= radius;
  target.edge_floor /= radius;
  return target;
}

}  // namespace

void RemeshTarget::validate() const {
  const auto require = [](bool holds, const char* option, double given, const char* range) {
    if (!holds) reject_input("--{} {:g}: must be {}", option, given, range);
  };
  if (by == By::nodes)
    require(value >= kFewestNodes && value <= kMostVertices, "nodes", value, "from 12 to 2e6");
  else
    require(value > 0.0 && std::isfinite(value), option_name(by), value, "positive");
  require(edge_floor >= 0.0 && std::isfinite(edge_floor), "edge-floor", edge_floor,
          "zero or positive");
  if (by == By::edge_length && edge_floor > 0.0)
    reject_input("--edge-floor {:g}: has no meaning with --edge-length", edge_floor);
  require(gradation > 0.0 && std::isfinite(gradation), "gradation", gradation, "positive");
}

TargetReport remesh_to(SurfaceMesh& mesh, const RemeshTarget& target) {
  target.validate();
  require_thickness(mesh, target);
  SurfaceMesh working = mesh;
  const Frame frame(mesh);
  frame.enter(working);
  const RemeshTarget inner = scaled(target, frame.radius);

  std::vector<Piece> pieces = pieces_of(working);
  if (inner.by == By::edge_length)
    require_affordable(inner, surface_area(working) * density_of_length(inner.value));
  const std::vector<Piece> given = pieces;
  const double rough_edge = even_out(pieces, inner);
  std::vector<bool> is_cavity;
  for (const Piece& piece : pieces) is_cavity.push_back(piece.is_cavity);

  Found found = rough_edge > 0.0 ? search_rough(given, pieces, inner, rough_edge)
                                 : TargetSearch(std::move(pieces), inner, 0.0, kMaxFailures).run();
  TargetReport report = std::move(found.report);
  std::vector<SurfaceMesh> result = std::move(found.pieces);
  if (result.empty()) {
    report.ok = false;
    return report;
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    if (is_cavity[i]) turn_inside_out(result[i]);
  working = joined(result);
  if (result.size() > 1)
    if (std::string fault = find_self_intersection(working); !fault.empty()) {
      report.ok = false;
      report.failure = std::move(fault);
      return report;
    }
  frame.leave(working);
  mesh = std::move(working);
  if (target.by != By::nodes) report.reached *= frame.radius;
  return report;
}

}  // namespace meniscus
