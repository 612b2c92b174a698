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

Vec3 Spines::velocity(const Vec3& x, const VertexField<Vec3>& drop_motion) const {
  MENISCUS_ASSERT(exist_ && drop_motion.size() == drop_.num_vertices(), "{} {}", drop_motion.size(),
                  drop_.num_vertices());
  const double r = (x - center_).norm();
  if (r == 0.0) return Vec3::Zero();
  const Vec3 direction = (x - center_) / r;
  const auto at_drop = drop_tree_.first_hit(center_, direction);
  if (!at_drop) return Vec3::Zero();  // cannot be: the drop is closed around its centre
  Vec3 motion = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    motion += at_drop->weights[static_cast<int>(k)] * drop_motion[drop_.faces[at_drop->face][k]];
  const double a = at_drop->distance;
  if (r <= a) return r / a * motion;
  const auto at_boundary = boundary_tree_.first_hit(center_, direction);
  if (!at_boundary || r >= at_boundary->distance) return Vec3::Zero();
  return (at_boundary->distance - r) / (at_boundary->distance - a) * motion;
}

}  // namespace meniscus
