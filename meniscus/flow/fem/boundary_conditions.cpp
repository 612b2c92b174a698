#include "meniscus/flow/fem/boundary_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::fem {
namespace {

// Faces of a curved wall meet at less than this, the walls of a channel at more.
const double same_piece = std::cos(40.0 * std::numbers::pi / 180.0);
// An interpolated flux is an O(h²) part of what passes; more is a mistake in the data.
constexpr double most_interpolated_flux = 0.2;
// Roundoff of a sum over some thousand faces.
constexpr double most_linear_flux = 1e-9;

struct Piece {
  PatchId patch;
  Vec3 area_vector;
};

/// The lowest patch with an imposed velocity at each vertex; invalid where there is none.
VertexField<PatchId> imposing_patch(const OuterBoundary& boundary) {
  VertexField<PatchId> result(boundary.mesh.num_vertices());
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const PatchId patch = boundary.patch[f];
    if (!std::holds_alternative<ImposedVelocity>(boundary.patches[patch].condition)) continue;
    for (const VertexId v : boundary.mesh.faces[f])
      if (!result[v].is_valid() || patch < result[v]) result[v] = patch;
  }
  return result;
}

/// The prescribed velocities, and the free flux of those that are not the linear flow removed.
struct ImposedValues {
  VertexField<PatchId> patch;
  VertexField<Vec3> velocity;
};

ImposedValues imposed_values(const OuterBoundary& boundary, double t) {
  ImposedValues values{imposing_patch(boundary),
                       VertexField<Vec3>(boundary.mesh.num_vertices(), Vec3::Zero())};
  for (const VertexId v : boundary.mesh.x.ids())
    if (values.patch[v].is_valid())
      values.velocity[v] = std::get<ImposedVelocity>(boundary.patches[values.patch[v]].condition)
                               .velocity(boundary.mesh.x[v], t);
  return values;
}

bool is_linear(const OuterBoundary& boundary, PatchId patch) {
  return std::get<ImposedVelocity>(boundary.patches[patch].condition).is_linear_flow;
}

/// Makes Σ A_i·v_i zero by v_i ← v_i − A_i (Σ A·v)/(Σ A²) over the vertices that are not of the
/// linear flow; returns why it cannot, or nothing.
std::string remove_net_flux(const OuterBoundary& boundary, ImposedValues& values) {
  const VertexField<Vec3> area = vertex_area_vectors(boundary.mesh);
  double flux = 0.0, gross = 0.0, squared = 0.0;
  for (const VertexId v : boundary.mesh.x.ids()) {
    const double through = area[v].dot(values.velocity[v]);
    flux += through;
    gross += std::abs(through);
    if (values.patch[v].is_valid() && !is_linear(boundary, values.patch[v]))
      squared += area[v].squaredNorm();
  }
  const double allowed = squared > 0.0 ? most_interpolated_flux : most_linear_flux;
  if (std::abs(flux) > allowed * gross)
    return fmt::format(
        "the imposed velocities have a net flux of {:.3g} out of a boundary without an open patch",
        flux);
  for (const VertexId v : boundary.mesh.x.ids())
    if (squared > 0.0 && values.patch[v].is_valid() && !is_linear(boundary, values.patch[v]))
      values.velocity[v] -= flux / squared * area[v];
  return {};
}

void add_tractions(const OuterBoundary& boundary, const EmbeddedSurface& embedded,
                   BoundaryConditions& conditions) {
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const auto* open = std::get_if<ImposedTraction>(&boundary.patches[boundary.patch[f]].condition);
    if (open == nullptr) continue;
    conditions.has_open_patch = true;
    const double third = face_area_vector(boundary.mesh, f).norm() / 3.0;
    for (const VertexId v : boundary.mesh.faces[f])
      conditions.traction[embedded.vertex(v)] += third * open->traction;
  }
}

std::vector<PatchId> impenetrable_patches(const OuterBoundary& boundary) {
  std::vector<PatchId> result;
  for (const PatchId patch : boundary.patches.ids())
    if (std::holds_alternative<NoPenetration>(boundary.patches[patch].condition))
      result.push_back(patch);
  return result;
}

}  // namespace

VertexField<std::vector<Vec3>> piece_normals(const SurfaceMesh& mesh,
                                             const FaceField<PatchId>& patch,
                                             const std::vector<PatchId>& wanted) {
  VertexField<std::vector<Piece>> pieces(mesh.num_vertices());
  for (const FaceId f : mesh.faces.ids()) {
    if (std::ranges::find(wanted, patch[f]) == wanted.end()) continue;
    const Vec3 area = face_area_vector(mesh, f);
    for (const VertexId v : mesh.faces[f]) {
      const auto same = std::ranges::find_if(pieces[v], [&](const Piece& piece) {
        return piece.patch == patch[f] &&
               piece.area_vector.normalized().dot(area.normalized()) > same_piece;
      });
      if (same != pieces[v].end())
        same->area_vector += area;
      else
        pieces[v].push_back({patch[f], area});
    }
  }
  VertexField<std::vector<Vec3>> normals(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids())
    for (const Piece& piece : pieces[v]) normals[v].push_back(piece.area_vector.normalized());
  return normals;
}

BoundaryConditions boundary_conditions(const OuterBoundary& boundary, const TetMesh& mesh,
                                       double t) {
  BoundaryConditions conditions{Constraints(mesh.num_vertices()),
                                Field<TetVertexId, Vec3>(mesh.num_vertices(), Vec3::Zero()),
                                false,
                                {}};
  add_tractions(boundary, mesh.boundary, conditions);
  ImposedValues values = imposed_values(boundary, t);
  if (!conditions.has_open_patch) conditions.failure = remove_net_flux(boundary, values);
  const VertexField<std::vector<Vec3>> normals =
      piece_normals(boundary.mesh, boundary.patch, impenetrable_patches(boundary));
  for (const VertexId v : boundary.mesh.x.ids()) {
    const TetVertexId at = mesh.boundary.vertex(v);
    if (values.patch[v].is_valid())
      conditions.constraints.fix(at, values.velocity[v]);
    else if (!normals[v].empty())
      conditions.constraints.forbid_penetration(at, normals[v]);
  }
  return conditions;
}

}  // namespace meniscus::fem
