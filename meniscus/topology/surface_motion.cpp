#include "meniscus/topology/surface_motion.hpp"

#include <utility>

#include "meniscus/core/error.hpp"

namespace meniscus {

void SurfaceMotion::add(SurfaceMesh mesh, VertexField<Vec3> velocity) {
  MENISCUS_ASSERT(velocity.size() == mesh.num_vertices(), "{} {}", velocity.size(),
                  mesh.num_vertices());
  surfaces_.push_back({std::move(mesh), std::move(velocity), nullptr});
}

Vec3 SurfaceMotion::at(const Vec3& x) const {
  SurfaceTree::Hit nearest;
  const Surface* moving = nullptr;
  for (Surface& surface : surfaces_) {
    if (surface.tree == nullptr) surface.tree = std::make_shared<SurfaceTree>(surface.mesh);
    const SurfaceTree::Hit hit = surface.tree->closest(x, nearest.distance);
    if (!hit.face.is_valid()) continue;
    nearest = hit;
    moving = &surface;
  }
  if (moving == nullptr) return Vec3::Zero();
  const FaceVertices& corners = moving->mesh.faces[nearest.face];
  Vec3 velocity = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    velocity += nearest.weights[static_cast<Eigen::Index>(k)] * moving->velocity[corners[k]];
  return velocity;
}

}  // namespace meniscus
