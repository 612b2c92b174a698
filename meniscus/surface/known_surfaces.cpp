#include "meniscus/surface/known_surfaces.hpp"

#include <iterator>
#include <string_view>

namespace meniscus {
namespace {

std::size_t hash_of(const VertexField<Vec3>& x) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const auto bytes = std::as_bytes(x.span());
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

ReconstructedSurface KnownSurfaces::made(const SurfaceMesh& mesh, SurfaceShape shape) const {
  if (shape != SurfaceShape::splined) return {mesh, shape};
  SurfaceTopology topology(mesh);
  SmoothSurface smooth(mesh, topology, share_);
  std::vector<Vec3> middles = middles_on_splines(mesh, topology, smooth, share_);
  return {mesh, std::move(topology), std::move(smooth), std::move(middles), shape};
}

std::shared_ptr<const ReconstructedSurface> KnownSurfaces::of(const SurfaceMesh& mesh,
                                                              SurfaceShape shape) {
  const std::size_t key = hash_of(mesh.x);
  for (auto [at, end] = known_.equal_range(key); at != end; ++at) {
    Known& known = at->second;
    if (known.surface->shape() != shape || known.surface->mesh() != mesh) continue;
    known.is_asked_for = true;
    return known.surface;
  }
  return known_
      .emplace(key, Known{std::make_shared<const ReconstructedSurface>(made(mesh, shape))})
      ->second.surface;
}

void KnownSurfaces::forget_unasked() {
  for (auto at = known_.begin(); at != known_.end();)
    at = std::exchange(at->second.is_asked_for, false) ? std::next(at) : known_.erase(at);
}

}  // namespace meniscus
