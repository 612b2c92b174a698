#include "meniscus/topology/bridge_gap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/repair/face_patch.hpp"
#include "meniscus/surface/repair/smooth_fill.hpp"
#include "meniscus/surface/repair/tube_faces.hpp"
#include "meniscus/surface/restore_volume.hpp"
#include "meniscus/topology/constants.hpp"

namespace meniscus {
namespace {

/// The holes that are tried, and whether they take all of the thin film around with them. Smaller
/// ones serve where the rim of a larger one comes round to the back of a drop or to another fold.
constexpr std::array<std::pair<double, bool>, 5> kHoles{
    {{kHole, true}, {kHole, false}, {1.5, false}, {1.0, false}, {0.5, false}}};
/// Edges at the hole, in limits: the rim of the film turns round within one limit.
constexpr double kEdge = 0.5;
constexpr int kRefinements = 8;  // remeshings at most: each can make edges four times shorter
/// A patch of film wider than this many of its edges is refined less: its rim is what matters.
constexpr double kPatchVertices = 2000.0;
constexpr double kMargin = 1.0;  // limits: beyond it a film is thicker than the edges of its rim
constexpr int kSmoothRings = 2;  // rings of faces around the tube that are smoothed with it

/// The edge that the surfaces are given around a gap.
double edge_at(const Gap& gap, const BridgeOptions& options) {
  MENISCUS_ASSERT(options.limit > 0.0, "limit = {}", options.limit);
  double spread = 0.0;
  for (const Vec3& x : gap.patch) spread = std::max(spread, (x - gap.middle()).norm());
  const double patch_area = std::numbers::pi * spread * spread;
  return std::max(
      {kEdge * options.limit, options.edge_floor, std::sqrt(patch_area / kPatchVertices)});
}

/// An interface's surface refined around the gap; as it is where that fails.
CarryingSurface refined_surface(const Interface& interface, const Gap& gap, double edge) {
  CarryingSurface surface{interface.mesh, interface.fields};
  RemeshOptions options = sound_remeshing(interface.C0);
  const double hole = kHole / kEdge * edge;
  const auto distance = [&](const Vec3& x) {
    double nearest = std::min((x - gap.from).norm(), (x - gap.to).norm()) - hole;
    for (const Vec3& p : gap.patch) nearest = std::min(nearest, (x - p).norm());
    return std::max(0.0, nearest);
  };
  options.size_bound = [&](const Vec3& x) { return edge + options.gradation * distance(x); };
  for (int i = 0; i < kRefinements; ++i) {
    const RemeshReport report = remesh(surface.mesh, options, surface.fields);
    if (!report.ok() || (report.splits == 0 && report.collapses == 0)) break;
  }
  return surface;
}

/// Both surfaces as one, outward from the liquid that the bridge belongs to.
CarryingSurface refined_surfaces(const Scene& scene, const Gap& gap, double edge) {
  const Interface &a = scene.interfaces[gap.a], &b = scene.interfaces[gap.b];
  CarryingSurface first = refined_surface(a, gap, edge);
  if (gap.a == gap.b) return first;
  CarryingSurface second = refined_surface(b, gap, edge);
  if (a.inside == b.outside) turn_inside_out(second.mesh);
  if (b.inside == a.outside) turn_inside_out(first.mesh);
  return {joined_surface(std::array{std::move(first.mesh), std::move(second.mesh)}),
          joined_fields(std::array{std::move(first.fields), std::move(second.fields)})};
}

/// The film seen from the surfaces around it.
struct Film {
  const SurfaceMesh& mesh;
  const SurfaceTopology& topology;
  const FaceNeighbours& neighbours;
  const SurfaceTree& tree;
  VertexField<Vec3> into;  // unit normals into the film

  [[nodiscard]] double width(VertexId v, double limit) const {
    return film_width(mesh, tree, mesh.x[v], into[v], limit);
  }
};

/// The vertex nearest to x that looks along `into`.
VertexId nearest_vertex(const Film& film, const Vec3& x, const Vec3& into) {
  VertexId best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const VertexId v : film.mesh.x.ids()) {
    const double distance = (film.mesh.x[v] - x).norm();
    if (distance >= best_distance || film.into[v].dot(into) <= 0.0) continue;
    best = v;
    best_distance = distance;
  }
  return best;
}

/// The faces around vertices, and around those that a walk along edges reaches without going
/// farther than `margin` from the one it began at.
FacePatch faces_around(const Film& film, std::vector<VertexId> vertices, double margin) {
  VertexField<VertexId> origin(film.mesh.num_vertices());
  for (const VertexId v : vertices) origin[v] = v;
  FacePatch patch(film.mesh.num_faces(), false);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const VertexId v = vertices[k];
    MENISCUS_ASSERT(origin[v].is_valid(), "vertex {}", v.value);
    for (const FaceId f : film.topology.faces_around(v)) patch[f] = true;
    for (const VertexId w : film.topology.ring(v)) {
      if (origin[w].is_valid() || (film.mesh.x[w] - film.mesh.x[origin[v]]).norm() > margin)
        continue;
      origin[w] = origin[v];
      vertices.push_back(w);
    }
  }
  return patch;
}

/// The faces around vertices that are reached from `start` through vertices within `hole` of it.
/// With `limit` > 0 those on a film thinner than that count too. With the film goes a margin as
/// wide as the limit. The rim is left where the film is thicker and can turn round, and it is less
/// ragged.
FacePatch hole_around(const Film& film, VertexId start, double hole, double limit) {
  VertexField<char> is_seen(film.mesh.num_vertices(), false);
  std::vector<VertexId> front{start};
  is_seen[start] = true;
  for (std::size_t k = 0; k < front.size(); ++k)
    for (const VertexId w : film.topology.ring(front[k])) {
      if (is_seen[w]) continue;
      is_seen[w] = true;
      const bool is_close = (film.mesh.x[w] - film.mesh.x[start]).norm() < hole;
      if (is_close || (limit > 0.0 && film.width(w, limit) < limit)) front.push_back(w);
    }
  return faces_around(film, std::move(front), kMargin * limit);
}

/// Volume of the film over the faces that making a patch a disc has added to it: half of what is
/// between the two sides.
double enclosed_film(const Film& film, const FacePatch& before, const FacePatch& after) {
  double volume = 0.0;
  const double far = (film.tree.high() - film.tree.low()).norm();
  for (const FaceId f : after.ids()) {
    if (before[f] || !after[f]) continue;
    const double area = face_area_vector(film.mesh, f).norm();
    for (const VertexId v : film.mesh.faces[f])
      volume += area / 3.0 * std::min(far, film.width(v, far));
  }
  return 0.5 * volume;
}

/// Discs of faces on the two sides of a film that are to be taken out.
using Holes = std::array<FacePatch, 2>;

/// Whether no vertex belongs to both and no edge joins one to the other: the tube between them
/// would have that edge a second time.
bool are_apart(const Film& film, const Holes& patches) {
  const auto touches = [&](VertexId v, std::size_t k) {
    return std::ranges::any_of(film.topology.faces_around(v),
                               [&](FaceId f) { return patches[k][f]; });
  };
  return std::ranges::none_of(film.mesh.x.ids(), [&](VertexId v) {
    if (!touches(v, 0)) return false;
    return touches(v, 1) ||
           std::ranges::any_of(film.topology.ring(v), [&](VertexId w) { return touches(w, 1); });
  });
}

/// The holes within `hole` of the closest place and, with `limit` > 0, of all film around it that
/// is thinner than that. There are none when they are no discs, run into one another, or would take
/// out film that can be resolved.
std::optional<Holes> holes(const Film& film, const std::array<VertexId, 2>& at, double hole,
                           double limit, const BridgeOptions& options) {
  Holes patches;
  double enclosed = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    patches[k] = hole_around(film, at[k], hole, limit);
    const FacePatch before = patches[k];
    if (!make_disc(film.mesh, film.topology, film.neighbours, patches[k])) return std::nullopt;
    enclosed += enclosed_film(film, before, patches[k]);
  }
  const double resolved = std::max(2.0 * options.limit, 4.0 * options.edge_floor);
  const double radius = sphere_radius(enclosed);
  if ((limit > 0.0 && radius > resolved) || !are_apart(film, patches)) return std::nullopt;
  return patches;
}

/// Makes `result` the surface with a tube between two holes in it, unless that is unsound.
std::optional<Fault> join(const SurfaceMesh& mesh, const Holes& patches, SurfaceMesh& result) {
  const auto first = boundary_curves(mesh, patches[0]), second = boundary_curves(mesh, patches[1]);
  MENISCUS_ASSERT(first && second && first->size() == 1 && second->size() == 1,
                  "holes that are no discs");
  FacePatch both = patches[0];
  for (const FaceId f : both.ids()) both[f] = both[f] || patches[1][f];
  result = remaining_surface(mesh, both);
  const std::int32_t num_kept = result.num_faces();
  for (const FaceVertices& f : tube_faces(mesh, first->front(), second->front()))
    result.faces.add(f);
  FacePatch tube(result.num_faces(), false);
  for (std::int32_t f = num_kept; f < result.num_faces(); ++f) tube[FaceId{f}] = true;
  SurfaceMesh smooth = result;
  if (smooth_part(smooth, tube, kSmoothRings) && !find_self_intersection(smooth)) {
    result = std::move(smooth);
    return {};
  }
  return find_defect(joined_surface(connected_pieces(result)));
}

/// Why an opening is not to be taken although its surface is sound: with the volume restored it
/// has more area, or meets itself.
std::optional<Fault> find_harm(const SurfaceMesh& before, SurfaceMesh after,
                               double most_added_area) {
  restore_volume(after, enclosed_volume(before));
  if (surface_area(after) - surface_area(before) > most_added_area)
    return Fault{FaultKind::added_area, "the bridge would add area"};
  return find_self_intersection(after);
}

/// A surgery, and the part of the liquid that it moves.
struct Opening {
  Surgery surgery;
  double moved = std::numeric_limits<double>::infinity();
};

/// One opening; why it is none, else.
Opening opening(const Film& film, const Holes& patches, double unit) {
  SurfaceMesh result;
  if (auto fault = join(film.mesh, patches, result)) return {{{}, std::move(fault)}};
  std::vector<SurfaceMesh> pieces = connected_pieces(result);  // without the vertices taken out
  SurfaceMesh whole = joined_surface(pieces);
  const double moved = std::abs(enclosed_volume(whole) / enclosed_volume(film.mesh) - 1.0);
  if (auto fault = find_harm(film.mesh, std::move(whole), kMostAddedByOpening * unit * unit))
    return {{{}, std::move(fault)}};
  return {{std::move(pieces), {}}, moved};
}

/// The first of the openings that leaves a sound surface, adds little area and moves little liquid.
/// Where all move much, it is the one that moves least. Why there is none, else.
Opening best_opening(const Film& film, const std::array<VertexId, 2>& at, double edge,
                     const BridgeOptions& options) {
  const double unit = edge / kEdge;  // the limit, but for patches too large for its edges
  Opening best{{{}, Fault{FaultKind::no_surgery, "no two discs can be opened there"}}};
  for (const auto& [radius, takes_film] : kHoles) {
    const auto patches = holes(film, at, radius * unit, takes_film ? options.limit : 0.0, options);
    if (!patches) continue;
    Opening next = opening(film, *patches, unit);
    if (next.moved < best.moved || best.surgery.pieces.empty()) best = std::move(next);
    if (best.moved < kMostMoved) break;
  }
  return best;
}

/// Where the smaller of two drops lies within the hole as a whole there is nothing to open it from:
/// the other takes it up. None where it is larger, or holds another drop.
std::optional<Surgery> absorption(const Scene& scene, const Gap& gap, double hole) {
  if (gap.a == gap.b) return std::nullopt;
  const Interface *large = &scene.interfaces[gap.a], *small = &scene.interfaces[gap.b];
  if (large->volume < small->volume) std::swap(large, small);
  const bool is_within = std::ranges::all_of(
      small->mesh.x, [&](const Vec3& x) { return (x - gap.middle()).norm() < hole; });
  const bool is_around = std::ranges::any_of(
      scene.interfaces, [&](const Interface& other) { return other.outside == small->inside; });
  if (!is_within || is_around) return std::nullopt;
  return Surgery{{large->mesh}, {}};
}

/// The bridge as `bridge_gap` makes it where both drops are larger than the hole.
Opening bridge_opening(const Scene& scene, const Gap& gap, const BridgeOptions& options) {
  const double edge = edge_at(gap, options);
  CarryingSurface surface = refined_surfaces(scene, gap, edge);
  const SurfaceMesh& mesh = surface.mesh;
  // The film lies outside the liquid of the bridge, or is that liquid when it lies inside of a.
  const Side side = gap.side;
  const SurfaceTopology topology(mesh);
  const FaceNeighbours neighbours = face_neighbours(mesh, topology);
  const SurfaceTree tree(mesh);
  Film film{mesh, topology, neighbours, tree, vertex_area_vectors(mesh)};
  const bool is_film_inside =
      gap.a == gap.b ? side == Side::inside
                     : scene.interfaces[gap.a].outside != scene.interfaces[gap.b].outside;
  for (Vec3& n : film.into) n = (is_film_inside ? -1.0 : 1.0) * n.normalized();

  const Vec3 across = gap.to - gap.from;
  const std::array<VertexId, 2> at{nearest_vertex(film, gap.from, across),
                                   nearest_vertex(film, gap.to, -across)};
  if (!at[0].is_valid() || !at[1].is_valid())
    return {{{}, Fault{FaultKind::no_surgery, "the two sides are not to be found", gap.middle()}}};
  Opening result = best_opening(film, at, edge, options);
  result.surgery.refined = std::move(surface);
  return result;
}

}  // namespace

Surgery bridge_gap(const Scene& scene, const Gap& gap, const BridgeOptions& options) {
  MENISCUS_ASSERT(gap.a < scene.interfaces.size() && gap.b < scene.interfaces.size(), "{} {}",
                  gap.a, gap.b);
  Opening bridge = bridge_opening(scene, gap, options);
  if (bridge.moved < kMostMoved) return std::move(bridge.surgery);
  return absorption(scene, gap, kHole * options.limit).value_or(std::move(bridge.surgery));
}

}  // namespace meniscus
