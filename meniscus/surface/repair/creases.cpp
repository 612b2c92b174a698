#include "meniscus/surface/repair/creases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/constants.hpp"
#include "meniscus/surface/repair/face_patch.hpp"
#include "meniscus/surface/repair/smooth_fill.hpp"

namespace meniscus {
namespace {

/// The faces beside creases.
FacePatch crease_patch(const SurfaceMesh& mesh, double crease_deg) {
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

bool is_empty(const FacePatch& patch) {
  return std::ranges::find(patch, char{true}) == patch.end();
}

/// All faces around the vertices that a walk along edges from those of a patch reaches without
/// going farther than `margin`.
FacePatch patch_within(const SurfaceMesh& mesh, const FacePatch& patch, double margin) {
  MENISCUS_ASSERT(patch.size() == mesh.num_faces(), "{} {}", patch.size(), mesh.num_faces());
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

bool has_volume_of(const SurfaceMesh& shape, double volume) {
  return std::abs(enclosed_volume(shape) / volume - 1.0) <= kMostMendedVolume;
}

}  // namespace

std::optional<SurfaceMesh> rounded_shape(SurfaceMesh mesh, const Rounding& rounding) {
  const FacePatch patch = crease_patch(mesh, rounding.crease_deg);
  if (is_empty(patch)) return std::nullopt;
  const double volume = enclosed_volume(mesh);
  if (!smooth_part(mesh, patch, rounding.rings)) return std::nullopt;
  if (!has_volume_of(mesh, volume)) return std::nullopt;
  return mesh;
}

std::optional<SurfaceMesh> capped_shape(const SurfaceMesh& mesh, double crease_deg, double margin) {
  const FacePatch patch = crease_patch(mesh, crease_deg);
  if (is_empty(patch)) return std::nullopt;
  std::vector<SurfaceMesh> left = connected_pieces(
      remaining_surface(mesh, patch_within(mesh, patch, margin * mean_edge(mesh))));
  if (left.empty()) return std::nullopt;
  SurfaceMesh closed = std::move(*std::ranges::max_element(left, {}, &SurfaceMesh::num_faces));
  if (!cap_holes(closed) || !has_volume_of(closed, enclosed_volume(mesh))) return std::nullopt;
  return closed;
}

}  // namespace meniscus
