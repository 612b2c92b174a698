#include "meniscus/mesh/solid_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/predicates.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

std::string place(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
}

std::string find_degenerate_face(const SurfaceMesh& mesh) {
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    if (is_degenerate({mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]}))
      return fmt::format("face {} near {} has no area", f.value, place(mesh.x[v[0]]));
  }
  return {};
}

std::string find_open_edge(const SurfaceMesh& mesh) {
  try {
    static_cast<void>(SurfaceTopology(mesh));
  } catch (const InvalidInput& fault) {
    return fault.what();
  }
  return {};
}

/// A piece that is inside out, but no cavity of another.
std::string find_inverted_piece(const SurfaceMesh& mesh) {
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
      return fmt::format("surface is inside out near {}: it encloses the volume {:.6g}", place(x),
                         volume);
  }
  return {};
}

}  // namespace

std::string find_solid_defect(const SurfaceMesh& mesh) {
  if (mesh.num_faces() == 0) return "surface has no faces";
  if (!is_finite(mesh)) return "surface is not finite";
  if (!std::isfinite(enclosed_volume(mesh)))
    return "coordinates are too large: the volume overflows";
  for (const auto find : {find_degenerate_face, find_open_edge})
    if (std::string fault = find(mesh); !fault.empty()) return fault;
  if (std::string fault = find_self_intersection(mesh); !fault.empty()) return fault;
  return find_inverted_piece(mesh);
}

}  // namespace meniscus
