#include "meniscus/flow/fem/boundary_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "meniscus/flow/fem/face_elements.hpp"
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

/// The lowest patch with an imposed velocity at each node; invalid where there is none.
Field<NodeId, PatchId> imposing_patch(const OuterBoundary& boundary, const FaceNodeTable& faces,
                                      std::int32_t num_nodes) {
  Field<NodeId, PatchId> result(num_nodes);
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const PatchId patch = boundary.patch[f];
    if (!std::holds_alternative<ImposedVelocity>(boundary.patches[patch].condition)) continue;
    for (const NodeId i : faces.of(f))
      if (!result[i].is_valid() || patch < result[i]) result[i] = patch;
  }
  return result;
}

/// The prescribed velocities by node.
struct ImposedValues {
  Field<NodeId, PatchId> patch;
  Field<NodeId, Vec3> velocity;
};

ImposedValues imposed_values(const OuterBoundary& boundary, const FaceNodeTable& faces,
                             const NodePositions& positions, double t) {
  ImposedValues values{imposing_patch(boundary, faces, positions.x.size()),
                       Field<NodeId, Vec3>(positions.x.size(), Vec3::Zero())};
  for (const NodeId i : positions.x.ids())
    if (values.patch[i].is_valid())
      values.velocity[i] = std::get<ImposedVelocity>(boundary.patches[values.patch[i]].condition)
                               .velocity(positions.x[i], t);
  return values;
}

bool is_linear(const OuterBoundary& boundary, PatchId patch) {
  return std::get<ImposedVelocity>(boundary.patches[patch].condition).is_linear_flow;
}

/// Makes Σ A_i·v_i zero by v_i ← v_i − A_i (Σ A·v)/(Σ A²) over the nodes that are not of the linear
/// flow; returns why it cannot, or nothing.
std::string remove_net_flux(const OuterBoundary& boundary, const Field<NodeId, Vec3>& area,
                            ImposedValues& values) {
  const auto is_free = [&](NodeId i) {
    return values.patch[i].is_valid() && !is_linear(boundary, values.patch[i]);
  };
  double flux = 0.0, gross = 0.0, squared = 0.0;
  for (const NodeId i : area.ids()) {
    const double through = area[i].dot(values.velocity[i]);
    flux += through;
    gross += std::abs(through);
    if (is_free(i)) squared += area[i].squaredNorm();
  }
  const double allowed = squared > 0.0 ? most_interpolated_flux : most_linear_flux;
  if (std::abs(flux) > allowed * gross)
    return fmt::format(
        "the imposed velocities have a net flux of {:.3g} out of a boundary without an open patch",
        flux);
  for (const NodeId i : area.ids())
    if (squared > 0.0 && is_free(i)) values.velocity[i] -= flux / squared * area[i];
  return {};
}

void add_tractions(const OuterBoundary& boundary, const FaceNodeTable& faces,
                   const NodePositions& positions, BoundaryConditions& conditions) {
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const auto* open = std::get_if<ImposedTraction>(&boundary.patches[boundary.patch[f]].condition);
    if (open == nullptr) continue;
    conditions.has_open_patch = true;
    const auto nodes = faces.of(f);
    for (const FacePoint& point : face_points(positions.x, nodes))
      for (std::size_t i = 0; i < nodes.size(); ++i)
        conditions.traction[nodes[i]] += point.value[i] * point.area.norm() * open->traction;
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

Field<NodeId, std::vector<Vec3>> piece_normals(const OuterBoundary& boundary,
                                               const std::vector<PatchId>& wanted,
                                               const FaceNodeTable& faces, std::int32_t num_nodes) {
  Field<NodeId, std::vector<Piece>> pieces(num_nodes);
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const PatchId patch = boundary.patch[f];
    if (std::ranges::find(wanted, patch) == wanted.end()) continue;
    const Vec3 area = face_area_vector(boundary.mesh, f);
    for (const NodeId i : faces.of(f)) {
      const auto same = std::ranges::find_if(pieces[i], [&](const Piece& piece) {
        return piece.patch == patch &&
               piece.area_vector.normalized().dot(area.normalized()) > same_piece;
      });
      if (same != pieces[i].end())
        same->area_vector += area;
      else
        pieces[i].push_back({patch, area});
    }
  }
  Field<NodeId, std::vector<Vec3>> normals(num_nodes);
  for (const NodeId i : pieces.ids())
    for (const Piece& piece : pieces[i]) normals[i].push_back(piece.area_vector.normalized());
  return normals;
}

BoundaryConditions boundary_conditions(const OuterBoundary& boundary, const FaceNodeTable& faces,
                                       const NodePositions& positions, double t) {
  const std::int32_t num_nodes = positions.x.size();
  BoundaryConditions conditions{
      Constraints(num_nodes), Field<NodeId, Vec3>(num_nodes, Vec3::Zero()), false, {}};
  add_tractions(boundary, faces, positions, conditions);
  ImposedValues values = imposed_values(boundary, faces, positions, t);
  if (!conditions.has_open_patch)
    conditions.failure = remove_net_flux(boundary, node_area_vectors(faces, positions.x), values);
  const Field<NodeId, std::vector<Vec3>> normals =
      piece_normals(boundary, impenetrable_patches(boundary), faces, num_nodes);
  for (const NodeId i : positions.x.ids()) {
    if (values.patch[i].is_valid())
      conditions.constraints.fix(i, values.velocity[i]);
    else if (!normals[i].empty())
      conditions.constraints.forbid_penetration(i, normals[i]);
  }
  return conditions;
}

}  // namespace meniscus::fem
