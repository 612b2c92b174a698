#include "meniscus/flow/fem/boundary_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Faces of a curved wall meet at less than this, the walls of a channel at more.
const double same_piece = std::cos(40.0 * std::numbers::pi / 180.0);
// An interpolated flux is an O(h²) part of what passes; more is a mistake in the data.
constexpr double most_interpolated_flux = 0.2;
// Roundoff of a sum over some thousand faces.
constexpr double most_linear_flux = 1e-9;
// Roundoff of A·v over |A| |v| where a wall slides in its plane.
constexpr double tangential = 1e-12;

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

/// A·v; exactly zero where the velocity lies in the plane.
double flux_through(const Vec3& area, const Vec3& velocity) {
  const double through = area.dot(velocity);
  return std::abs(through) > tangential * area.norm() * velocity.norm() ? through : 0.0;
}

/// Makes Σ A_i·v_i zero by v_i ← v_i − A_i/A_i² |A_i·v_i| (Σ A·v)/(Σ |A·v|), the last sum over the
/// nodes that are not of the linear flow. A sum too large for that is left.
std::optional<Fault> remove_net_flux(const OuterBoundary& boundary, const Field<NodeId, Vec3>& area,
                                     ImposedValues& values) {
  const auto is_free = [&](NodeId i) {
    return values.patch[i].is_valid() && !is_linear(boundary, values.patch[i]);
  };
  double flux = 0.0, gross = 0.0, gross_of_free = 0.0;
  for (const NodeId i : area.ids()) {
    if (!values.patch[i].is_valid()) continue;  // no velocity is imposed
    const double through = flux_through(area[i], values.velocity[i]);
    flux += through;
    gross += std::abs(through);
    if (is_free(i)) gross_of_free += std::abs(through);
  }
  const double allowed = gross_of_free > 0.0 ? most_interpolated_flux : most_linear_flux;
  if (std::abs(flux) > allowed * gross)
    return Fault{FaultKind::no_flow,
                 fmt::format("the imposed velocities have a net flux of {:.3g} out of a boundary "
                             "without an open patch",
                             flux)};
  for (const NodeId i : area.ids()) {
    if (!is_free(i)) continue;
    const double through = std::abs(flux_through(area[i], values.velocity[i]));
    if (through > 0.0) {
      MENISCUS_ASSERT(area[i].squaredNorm() > 0.0, "node {}", i.value);
      values.velocity[i] -= flux / gross_of_free * through / area[i].squaredNorm() * area[i];
    }
  }
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

/// The faces of wanted patches at each node, in rising order: those of node i are from start[i] on.
struct FacesOfNodes {
  std::vector<std::int32_t> start;
  std::vector<FaceId> faces;
};

FacesOfNodes faces_of_nodes(const OuterBoundary& boundary, const std::vector<PatchId>& wanted,
                            const FaceNodeTable& faces, std::int32_t num_nodes) {
  const auto for_each_pair = [&](auto&& visit) {
    for (const FaceId f : boundary.mesh.faces.ids())
      if (std::ranges::find(wanted, boundary.patch[f]) != wanted.end())
        for (const NodeId i : faces.of(f)) visit(at(i.value), f);
  };
  FacesOfNodes result;
  result.start.assign(at(num_nodes) + 1, 0);
  for_each_pair([&](std::size_t i, FaceId) { ++result.start[i + 1]; });
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  result.faces.resize(at(result.start.back()));
  std::vector<std::int32_t> next(result.start.begin(), result.start.end() - 1);
  for_each_pair([&](std::size_t i, FaceId f) {
    MENISCUS_ASSERT(next[i] < result.start[i + 1], "node {}", i);
    result.faces[at(next[i]++)] = f;
  });
  return result;
}

struct Piece {
  PatchId patch;
  Vec3 area_vector;
};

/// Adds a face to the piece that it belongs to, or makes one of it.
void add_to_pieces(std::vector<Piece>& pieces, PatchId patch, const Vec3& area) {
  const auto same = std::ranges::find_if(pieces, [&](const Piece& piece) {
    return piece.patch == patch &&
           piece.area_vector.normalized().dot(area.normalized()) > same_piece;
  });
  if (same != pieces.end())
    same->area_vector += area;
  else
    pieces.push_back({patch, area});
}

}  // namespace

PieceNormals piece_normals(const OuterBoundary& boundary, const std::vector<PatchId>& wanted,
                           const FaceNodeTable& faces, std::int32_t num_nodes) {
  const FacesOfNodes around = faces_of_nodes(boundary, wanted, faces, num_nodes);
  PieceNormals result;
  result.start.reserve(at(num_nodes) + 1);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < at(num_nodes); ++i) {
    pieces.clear();
    for (std::size_t k = at(around.start[i]); k < at(around.start[i + 1]); ++k)
      add_to_pieces(pieces, boundary.patch[around.faces[k]],
                    face_area_vector(boundary.mesh, around.faces[k]));
    for (const Piece& piece : pieces) result.normals.push_back(piece.area_vector.normalized());
    result.start.push_back(static_cast<std::int32_t>(result.normals.size()));
  }
  return result;
}

BoundaryConditions boundary_conditions(const OuterBoundary& boundary, const FaceNodeTable& faces,
                                       const NodePositions& positions, double t) {
  const std::int32_t num_nodes = positions.x.size();
  BoundaryConditions conditions{
      Constraints(num_nodes), Field<NodeId, Vec3>(num_nodes, Vec3::Zero()), false, {}};
  add_tractions(boundary, faces, positions, conditions);
  ImposedValues values = imposed_values(boundary, faces, positions, t);
  if (!conditions.has_open_patch)
    conditions.fault = remove_net_flux(boundary, node_area_vectors(faces, positions.x), values);
  const std::vector<PatchId> walls = impenetrable_patches(boundary);
  const PieceNormals normals =
      walls.empty() ? PieceNormals{} : piece_normals(boundary, walls, faces, num_nodes);
  for (const NodeId i : positions.x.ids()) {
    if (values.patch[i].is_valid())
      conditions.constraints.fix(i, values.velocity[i]);
    else if (!walls.empty() && !normals.of(i).empty())
      conditions.constraints.forbid_penetration(i, normals.of(i));
  }
  return conditions;
}

}  // namespace meniscus::fem
