#include "meniscus/topology/mend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/diffused.hpp"
#include "meniscus/surface/even_out.hpp"
#include "meniscus/surface/repair.hpp"
#include "meniscus/topology/smooth_fill.hpp"

namespace meniscus {
namespace {

/// What is tried, the least first: how sharp an edge is smoothed, and how many rings of faces
/// around it move along. Normals turn by 42° on an icosahedron, the coarsest sphere there is to be
/// remeshed.
struct Rounding {
  double crease_deg;
  int rings;
};
constexpr std::array<Rounding, 5> kRoundings{
    {{70.0, 0}, {70.0, 1}, {70.0, 2}, {70.0, 4}, {50.0, 0}}};
constexpr std::array<double, 4> kMargins{0.5, 1.0, 2.0, 3.0};  // mean edges
constexpr double kEvenEdge = 0.5;  // of the mean edge: creases need faces to be rounded with
/// Lengths that a crumpled surface is smoothed over, mean edges: from what the lattice resolves to
/// where a fold of two edges' width is gone.
constexpr std::array<double, 5> kLengths{0.5, 0.71, 1.0, 1.41, 2.0};

/// The faces beside creases.
FacePatch creases(const SurfaceMesh& mesh, double crease_deg) {
  const double least = std::cos(crease_deg * std::numbers::pi / 180.0);
  FacePatch patch(mesh.num_faces(), false);
  const SurfaceTopology topology(mesh);
  for (const SurfaceEdge& e : topology.edges()) {
    const Vec3 left = face_area_vector(mesh, e.left).normalized(),
               right = face_area_vector(mesh, e.right).normalized();
    if (left.dot(right) < least) patch[e.left] = patch[e.right] = true;
  }
  return patch;
}

/// The surface with its creases rounded; none where it has none, or too much moves.
std::optional<SurfaceMesh> rounded(SurfaceMesh mesh, const Rounding& rounding) {
  const FacePatch patch = creases(mesh, rounding.crease_deg);
  if (std::ranges::find(patch, char{true}) == patch.end()) return std::nullopt;
  const double before = enclosed_volume(mesh);
  if (!smooth_part(mesh, patch, rounding.rings)) return std::nullopt;
  if (std::abs(enclosed_volume(mesh) / before - 1.0) > kMostMendedVolume) return std::nullopt;
  return mesh;
}

/// The vertices that a walk along edges from those of the faces of a patch reaches without going
/// farther than `margin`, as a patch of all faces around them.
FacePatch widened(const SurfaceMesh& mesh, const FacePatch& patch, double margin) {
  const SurfaceTopology topology(mesh);
  VertexField<VertexId> origin(mesh.num_vertices());
  std::vector<VertexId> front;
  for (const FaceId f : patch.ids()) {
    if (!patch[f]) continue;
    for (const VertexId v : mesh.faces[f])
      if (!std::exchange(origin[v], v).is_valid()) front.push_back(v);
  }
  FacePatch wide(mesh.num_faces(), false);
  for (std::size_t k = 0; k < front.size(); ++k) {
    const VertexId v = front[k];
    for (const FaceId f : topology.faces_around(v)) wide[f] = true;
    for (const VertexId w : topology.ring(v)) {
      if (origin[w].is_valid() || (mesh.x[w] - mesh.x[origin[v]]).norm() > margin) continue;
      origin[w] = origin[v];
      front.push_back(w);
    }
  }
  return wide;
}

/// The surface with what lies within `margin` mean edges of its creases cut out and closed
/// smoothly: a crevice or a thorn goes as a whole. None where an end cannot be closed, or too much
/// moves.
std::optional<SurfaceMesh> recapped(const SurfaceMesh& mesh, double margin) {
  const FacePatch patch = creases(mesh, kRoundings.front().crease_deg);
  if (std::ranges::find(patch, char{true}) == patch.end()) return std::nullopt;
  std::vector<SurfaceMesh> left =
      connected_pieces(without(mesh, widened(mesh, patch, margin * mean_edge(mesh))));
  if (left.empty()) return std::nullopt;
  SurfaceMesh closed = std::move(*std::ranges::max_element(left, {}, &SurfaceMesh::num_faces));
  if (!cap_holes(closed)) return std::nullopt;
  if (std::abs(enclosed_volume(closed) / enclosed_volume(mesh) - 1.0) > kMostMendedVolume)
    return std::nullopt;
  return closed;
}

/// The first capping of a surface that can be remeshed.
std::optional<MendReport> recap_and_remesh(SurfaceMesh& mesh, SurfaceFields& fields,
                                           const RemeshOptions& options, double volume) {
  const int euler = euler_characteristic(mesh);
  for (const double margin : kMargins) {
    std::optional<SurfaceMesh> capped = recapped(mesh, margin);
    if (!capped) continue;
    const auto report = repair_and_remesh(mesh, fields, std::move(*capped), volume, options);
    if (report) return MendReport{*report, true, (euler_characteristic(mesh) - euler) / 2};
  }
  return std::nullopt;
}

/// The first rounding of a surface that can be remeshed.
std::optional<RemeshReport> round_and_remesh(SurfaceMesh& mesh, SurfaceFields& fields,
                                             const RemeshOptions& options, double volume) {
  for (const Rounding& rounding : kRoundings) {
    std::optional<SurfaceMesh> round = rounded(mesh, rounding);
    if (!round) continue;
    auto report = repair_and_remesh(mesh, fields, std::move(*round), volume, options);
    if (report) return report;
  }
  return std::nullopt;
}

/// The least smoothed of the surfaces of the same volume that can be remeshed. None may have more
/// holes than there were.
std::optional<MendReport> diffuse_and_remesh(SurfaceMesh& mesh, SurfaceFields& fields,
                                             const RemeshOptions& options) {
  if (!find_self_intersection(mesh).empty()) return std::nullopt;  // it has no inside
  const double edge = mean_edge(mesh);
  DiffusedSurface diffused(mesh, edge);
  for (const double length : kLengths) {
    std::optional<SurfaceMesh> smooth = diffused.smoothed(length * edge, kMostMendedVolume);
    if (!smooth) continue;
    const int closed = (euler_characteristic(*smooth) - euler_characteristic(mesh)) / 2;
    if (closed < 0) continue;
    const auto report = repair_and_remesh(mesh, fields, std::move(*smooth), 0.0, options);
    if (report) return MendReport{*report, true, closed, length * edge};
  }
  return std::nullopt;
}

}  // namespace

MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& options) {
  SurfaceFields none;
  return remesh_or_mend(mesh, options, none);
}

MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& given, SurfaceFields& fields) {
  MendReport report{.remesh = remesh(mesh, given, fields)};
  if (report.remesh.ok) return report;
  RemeshOptions options = given;
  if (options.volume == 0.0) options.volume = enclosed_volume(mesh);
  const double volume = options.volume;
  if (!(volume > 0.0)) return report;  // turned inside out: no shape to be mended
  if (const auto remeshed = round_and_remesh(mesh, fields, options, volume))
    return {*remeshed, true};
  SurfaceMesh even = evened_out(mesh, kEvenEdge * mean_edge(mesh));
  auto [even_fields, excess] = replaced_fields(fields, mesh, even);
  const auto replaced = [&](RemeshReport remeshed) {
    widen(remeshed.field_excess, excess);
    mesh = std::move(even);
    fields = std::move(even_fields);
    return MendReport{std::move(remeshed), true};
  };
  if (const RemeshReport remeshed = remesh(even, options, even_fields); remeshed.ok)
    return replaced(remeshed);
  if (const auto mended = recap_and_remesh(mesh, fields, options, volume)) return *mended;
  if (const auto remeshed = round_and_remesh(even, even_fields, options, volume))
    return replaced(*remeshed);
  if (const auto mended = diffuse_and_remesh(mesh, fields, options)) return *mended;
  return report;
}

}  // namespace meniscus
