#include "meniscus/solids/remesh_target.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/solids/rough_pieces.hpp"
#include "meniscus/solids/target_search.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"
#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

using By = RemeshTarget::By;

/// Scales a surface to an equivalent radius of 1, its middle at the origin.
struct Scaling {
  Vec3 center;
  double radius;
  explicit Scaling(const SurfaceMesh& mesh)
      : center(mean_vertex(mesh)), radius(sphere_radius(enclosed_volume(mesh))) {
    MENISCUS_ASSERT(radius > 0.0, "a surface without volume");
  }
  void apply(SurfaceMesh& mesh) const {
    for (Vec3& x : mesh.x) x = (x - center) / radius;
  }
  void undo(SurfaceMesh& mesh) const {
    for (Vec3& x : mesh.x) x = center + radius * x;
  }
};

/// The pieces of a surface; those that lie inside out in another are turned and marked.
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

/// The target for a surface that was scaled by 1/radius.
RemeshTarget scaled_target(RemeshTarget target, double radius) {
  if (target.by != By::nodes) target.value /= radius;
  target.edge_floor /= radius;
  return target;
}

/// Remeshes a smooth surface. One with slivers, but no creases, is taken for smooth where the
/// target is met so. Else, as with creases, its triangles are made even first.
Found search(const std::vector<Piece>& pieces, const RemeshTarget& target) {
  const auto any = [&](auto&& is_so) {
    return std::ranges::any_of(
        pieces, [&](const Piece& piece) { return is_so(piece.mesh, SurfaceTopology(piece.mesh)); });
  };
  if (any(has_creases)) return search_rough(pieces, target);
  Found smooth = TargetSearch(pieces, target, 0.0, kMostFailures).run();
  if (smooth.report.is_met || !any(is_rough)) return smooth;
  return search_rough(pieces, target);
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
  const Scaling scaling(mesh);
  scaling.apply(working);
  const RemeshTarget inner = scaled_target(target, scaling.radius);

  const std::vector<Piece> pieces = pieces_of(working);
  if (inner.by == By::edge_length)
    require_affordable(inner, surface_area(working) * density_of_length(inner.value));
  Found found = search(pieces, inner);
  TargetReport report = std::move(found.report);
  std::vector<SurfaceMesh> result = std::move(found.pieces);
  if (result.empty()) return report;
  MENISCUS_ASSERT(result.size() == pieces.size(), "{} pieces of {}", result.size(), pieces.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    if (pieces[i].is_cavity) turn_inside_out(result[i]);
  working = joined_surface(result);
  if (result.size() > 1)
    if (auto fault = find_self_intersection(working)) {
      report.fault = std::move(fault);
      return report;
    }
  scaling.undo(working);
  mesh = std::move(working);
  if (target.by != By::nodes) report.reached *= scaling.radius;
  return report;
}

}  // namespace meniscus
