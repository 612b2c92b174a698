#include "meniscus/solids/rough_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"
#include "meniscus/surface/repair/replacement.hpp"
#include "meniscus/surface/repair/smoothed_shapes.hpp"
#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

using By = RemeshTarget::By;

constexpr double kRoughEdge = 0.5;  // of the target's mean edge
/// Edge of the even triangles over the chordal error: creases are rounded by about half of it.
constexpr double kRoughChord = 2.0;
/// Vertices on creases over those that the area takes, above which a surface is a needle. That of a
/// bar, one edge thick, is near 1. Beyond, CGAL makes fans of triangles without end.
constexpr double kMostOnCreases = 2.5;

/// Lengths that rough pieces are smoothed over, in edges of the rough surface: none at first.
std::vector<double> roundings() {
  std::vector<double> lengths{0.0};
  lengths.insert(lengths.end(), kSmoothingLengths.begin(), kSmoothingLengths.end());
  return lengths;
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

/// Gives rough pieces even triangles; returns their length.
double remesh_rough_pieces(std::vector<Piece>& pieces, const RemeshTarget& target) {
  double area = 0.0;
  for (const Piece& piece : pieces) area += surface_area(piece.mesh);
  double edge = 0.0;
  for (Piece& piece : pieces) {
    piece.is_rough = is_rough(piece.mesh, SurfaceTopology(piece.mesh));
    if (!piece.is_rough) continue;
    edge = rough_edge_length(target, area);
    piece.mesh = isotropic_remesh(piece.mesh, edge);
  }
  return edge;
}

/// Pieces whose rough ones can be smoothed over lengths, each not less than the last.
class RoughPieces {
 public:
  RoughPieces(const std::vector<Piece>& pieces, double edge) : pieces_(pieces), edge_(edge) {}

  /// None where that loses what is thinner than the length, or a hole.
  std::optional<std::vector<Piece>> at(double length) {
    if (length == 0.0) return pieces_;
    std::vector<Piece> smooth = pieces_;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      if (!smooth[i].is_rough) continue;
      SurfaceMesh& mesh = smooth[i].mesh;
      const auto found = shapes_.try_emplace(i, mesh, edge_).first;
      std::optional<SurfaceMesh> round = found->second.at(length);
      if (!round || euler_characteristic(*round) != euler_characteristic(mesh)) return std::nullopt;
      std::optional<Replacement> next = sound_replacement(mesh, {}, *std::move(round), 0.0);
      if (!next) return std::nullopt;
      mesh = std::move(next->surface.mesh);
    }
    return smooth;
  }

 private:
  const std::vector<Piece>& pieces_;
  double edge_;
  std::map<std::size_t, SmoothedShapes> shapes_;
};

/// The first of the roundings that meets the target; if none does, the one that comes nearest.
Found search_rounded(const std::vector<Piece>& pieces, const RemeshTarget& target,
                     double rough_edge) {
  RoughPieces rough(pieces, rough_edge);
  Found best;
  int passes = 0;
  for (const double rounding : roundings()) {
    std::optional<std::vector<Piece>> smooth = rough.at(rounding * rough_edge);
    if (!smooth) break;
    const int failures = rounding == kSmoothingLengths.back() ? kMostFailures : 1;
    Found found = TargetSearch(std::move(*smooth), target, rough_edge, failures).run();
    passes += found.report.passes;
    if (found.miss < best.miss || (best.pieces.empty() && !best.report.fault))
      best = std::move(found);
    if (best.report.is_met) break;
  }
  best.report.passes = passes;
  best.report.are_creases_rounded = true;
  if (best.report.fault)
    best.report.fault->text +=
        "; parts are too thin, or edges too sharp, for triangles as large as asked for";
  return best;
}

/// Pieces in even triangles on their flat faces; none where that leaves one unsound.
std::vector<SurfaceMesh> cut_evenly(const std::vector<Piece>& pieces, double edge) {
  std::vector<SurfaceMesh> even;
  for (const Piece& piece : pieces) {
    std::optional<Replacement> next =
        sound_replacement(piece.mesh, {}, isotropic_remesh(piece.mesh, edge), piece.volume);
    if (!next) return {};
    even.push_back(std::move(next->surface.mesh));
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
  double setting = target.value, last_setting = 0.0, last_measure = 0.0;
  while (best.report.passes < kMostPasses && !best.report.is_met) {
    ++best.report.passes;
    const bool counts = target.by == By::nodes;
    std::vector<SurfaceMesh> even = cut_evenly(
        pieces, std::max(counts ? length_of_density(setting / area) : setting, target.edge_floor));
    if (even.empty()) break;
    const SurfaceMesh all = joined_surface(even);
    const double measure = counts ? all.num_vertices() : mean_edge(all);
    if (measure == last_measure) break;
    const double miss = std::abs(std::log(measure / target.value));
    if (miss < best.miss) {
      best.miss = miss;
      best.pieces = std::move(even);
      best.report.reached = measure;
      best.report.is_met = miss <= band(target.by);
    }
    const double next = next_setting(setting, measure, last_setting, last_measure, target.value);
    last_setting = setting;
    last_measure = measure;
    setting = next;
  }
  return best;
}

}  // namespace

void require_thickness(const SurfaceMesh& mesh, const RemeshTarget& target) {
  const SurfaceTopology topology(mesh);
  if (!has_creases(mesh, topology)) return;
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

Found search_rough(const std::vector<Piece>& given, const RemeshTarget& target) {
  std::vector<Piece> even = given;
  const double rough_edge = remesh_rough_pieces(even, target);
  Found rounded = search_rounded(even, target, rough_edge);
  if (!rounded.pieces.empty()) return rounded;
  Found cut = search_cut(given, target, rough_edge);
  if (cut.pieces.empty()) return rounded;
  cut.report.passes += rounded.report.passes;
  return cut;
}

}  // namespace meniscus
