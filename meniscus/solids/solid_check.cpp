#include "meniscus/solids/solid_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

/// A piece that is inside out, but no cavity of another.
std::optional<Fault> find_inverted_piece(const SurfaceMesh& mesh) {
  const std::vector<SurfaceMesh> pieces = connected_pieces(mesh);
  for (const SurfaceMesh& piece : pieces) {
    const double volume = enclosed_volume(piece);
    if (volume > 0.0) continue;
    const Vec3& x = piece.x[VertexId{0}];
    // Pieces do not cross (that was checked), so that any vertex tells where the piece lies.
    const auto is_around = [&](const SurfaceMesh& other) {
      return &other != &piece && enclosed_volume(other) > 0.0 && encloses(other, x);
    };
    if (volume == 0.0 || std::ranges::none_of(pieces, is_around))
      return Fault{FaultKind::no_volume,
                   fmt::format("surface is inside out near {}: it encloses the volume {:.6g}",
                               text_of(x), volume),
                   x};
  }
  return {};
}

}  // namespace

std::optional<Fault> find_solid_defect(const SurfaceMesh& mesh) {
  if (mesh.num_faces() == 0) return Fault{FaultKind::connectivity, "surface has no faces"};
  if (!is_finite(mesh)) return Fault{FaultKind::not_finite, "surface is not finite"};
  if (!std::isfinite(enclosed_volume(mesh)))
    return Fault{FaultKind::not_finite, "coordinates are too large: the volume overflows"};
  if (auto fault = find_degenerate_face(mesh)) return fault;
  if (auto fault = find_broken_connectivity(mesh)) return fault;
  if (auto fault = find_self_intersection(mesh)) return fault;
  return find_inverted_piece(mesh);
}

}  // namespace meniscus
