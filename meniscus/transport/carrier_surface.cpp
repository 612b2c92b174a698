#include "meniscus/transport/carrier_surface.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus {

CarrierSurface::CarrierSurface(const SurfaceMesh& mesh, SurfaceShape shape)
    : mesh_(mesh), surface_(mesh, shape) {}

CarrierSurface::Points CarrierSurface::points(FaceId f) const {
  MENISCUS_ASSERT(f.value < mesh_.num_faces(), "{} of {}", f.value, mesh_.num_faces());
  const FaceVertices& v = mesh_.faces[f];
  const bool is_flat = surface_.quadratic_faces().empty();
  const TriangleTangents flat{mesh_.x[v[1]] - mesh_.x[v[0]], mesh_.x[v[2]] - mesh_.x[v[0]]};
  Points points;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto& [b, share] = kTriangleRule4[q];
    const TriangleTangents at =
        is_flat ? flat : tangents(quadratic_shape(b), surface_.quadratic_faces()[f]);
    const TriangleGradients g = surface_gradients(at);
    points[q] = {
        .value = b, .gradient = {-g.g1 - g.g2, g.g1, g.g2}, .area = share * at.area().norm()};
  }
  return points;
}

}  // namespace meniscus
