#include "meniscus/topology/cut_neck.hpp"

#include <optional>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/triangle.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/repair/face_patch.hpp"
#include "meniscus/surface/repair/smooth_fill.hpp"

namespace meniscus {
namespace {

/// Half-width of the band, in radii. On a cylinder its ends lie 1.1 radii from the middle and the
/// domes that close them are half a radius high. So as much is taken off the lateral area as domes
/// add, and they stay 1.2 radii apart. The others are tried where the band is no ring, as beside a
/// bulge.
constexpr std::array<double, 4> kReaches{1.5, 1.25, 2.0, 1.0};

Triangle corners(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return {mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]};
}

/// The faces that the section crosses, and those joined to them that come within `reach` of the
/// middle of the neck.
FacePatch band_around(const SurfaceMesh& mesh, const FaceNeighbours& neighbours, const Neck& neck,
                      double reach) {
  MENISCUS_ASSERT(!neck.faces.empty() && reach > 0.0, "reach = {}", reach);
  FacePatch band(mesh.num_faces(), false);
  std::vector<FaceId> front = neck.faces;
  for (const FaceId f : front) band[f] = true;
  for (std::size_t k = 0; k < front.size(); ++k)
    for (const FaceId f : neighbours[front[k]]) {
      if (band[f]) continue;
      const Vec3 nearest = closest_point(corners(mesh, f), neck.center).point;
      if ((nearest - neck.center).norm() > reach) continue;
      band[f] = true;
      front.push_back(f);
    }
  return band;
}

/// Takes one band out and closes its ends, unless that fails.
std::optional<Fault> cut(const SurfaceMesh& mesh, const FacePatch& band,
                         std::vector<SurfaceMesh>& pieces) {
  const std::vector<SurfaceMesh> open = connected_pieces(remaining_surface(mesh, band));
  SurfaceMesh closed = joined_surface(open);
  if (!cap_holes(closed)) return Fault{FaultKind::no_surgery, "an end could not be closed"};
  if (auto fault = find_self_intersection(closed)) return fault;
  pieces = connected_pieces(closed);
  return {};
}

}  // namespace

Surgery cut_neck(const SurfaceMesh& mesh, const Neck& neck) {
  const SurfaceTopology topology(mesh);
  const FaceNeighbours neighbours = face_neighbours(mesh, topology);
  Surgery surgery{
      {}, Fault{FaultKind::no_surgery, "the faces around the neck form no ring", neck.center}};
  for (const double reach : kReaches) {
    FacePatch band = band_around(mesh, neighbours, neck, reach * neck.radius);
    if (!make_ring(mesh, topology, neighbours, band)) continue;
    surgery.fault = cut(mesh, band, surgery.pieces);
    if (!surgery.fault) return surgery;
  }
  return surgery;
}

}  // namespace meniscus
