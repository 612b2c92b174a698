#include "meniscus/volume/spines.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/predicates.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// Whether every face shows its inner side to the centre.
bool is_star_shaped(const SurfaceMesh& mesh, const Vec3& center) {
  return std::ranges::all_of(mesh.faces, [&](const FaceVertices& v) {
    return orientation(center, mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]) > 0;
  });
}

}  // namespace

Spines::Spines(const SurfaceMesh& drop, const SurfaceMesh& boundary)
    : drop_(drop),
      center_(enclosed_centroid(drop)),
      drop_tree_(drop),
      boundary_tree_(boundary),
      exist_(is_star_shaped(drop, center_) && is_star_shaped(boundary, center_)) {}

Spine Spines::through(const Vec3& x) const {
  MENISCUS_ASSERT(exist_, "a surface that is not star-shaped");
  const Spine at_rest{{VertexId{0}, VertexId{0}, VertexId{0}}};
  const double r = (x - center_).norm();
  if (r == 0.0) return at_rest;
  const Vec3 direction = (x - center_) / r;
  const auto at_drop = drop_tree_.first_hit(center_, direction);
  if (!at_drop) return at_rest;  // cannot be: the drop is closed around its centre
  const FaceVertices& corners = drop_.faces[at_drop->face];
  const double a = at_drop->distance;
  if (r <= a) return {corners, r / a * at_drop->weights};
  const auto at_boundary = boundary_tree_.first_hit(center_, direction);
  if (!at_boundary || r >= at_boundary->distance) return at_rest;
  return {corners, (at_boundary->distance - r) / (at_boundary->distance - a) * at_drop->weights};
}

}  // namespace meniscus
