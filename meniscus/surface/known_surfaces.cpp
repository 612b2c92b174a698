#include "meniscus/surface/known_surfaces.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <string_view>

#include "meniscus/core/archive_entries.hpp"

namespace meniscus {
namespace {

std::size_t hash_of(const VertexField<Vec3>& x) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const auto bytes = std::as_bytes(x.span());
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

std::shared_ptr<const ReconstructedSurface> KnownSurfaces::made(const SurfaceMesh& mesh,
                                                                SurfaceShape shape) const {
  if (shape != SurfaceShape::splined)
    return std::make_shared<const ReconstructedSurface>(mesh, shape);
  SurfaceTopology topology(mesh);
  SmoothSurface smooth(mesh, topology, share_);
  std::vector<Vec3> middles = middles_on_splines(mesh, topology, smooth, share_);
  return std::make_shared<const ReconstructedSurface>(mesh, std::move(topology), std::move(smooth),
                                                      std::move(middles), shape);
}

KnownSurfaces::KnownByHash::iterator KnownSurfaces::find(const SurfaceMesh& mesh,
                                                         SurfaceShape shape) {
  const auto [first, last] = known_.equal_range(hash_of(mesh.x));
  const auto found = std::find_if(first, last, [&](const auto& entry) {
    const ReconstructedSurface& surface = *entry.second.surface;
    return surface.shape() == shape && surface.mesh() == mesh;
  });
  return found == last ? known_.end() : found;
}

KnownSurfaces::Known& KnownSurfaces::add(Known known) {
  const std::size_t key = hash_of(known.surface->mesh().x);
  return known_.emplace(key, std::move(known))->second;
}

KnownSurfaces::Known& KnownSurfaces::add_scaled(
    std::shared_ptr<const ReconstructedSurface> unscaled, const Dilation& dilation) {
  auto scaled = std::make_shared<const ReconstructedSurface>(unscaled->scaled(dilation));
  if (const auto found = find(scaled->mesh(), scaled->shape()); found != known_.end())
    known_.erase(found);
  return add({.surface = std::move(scaled), .unscaled = std::move(unscaled), .dilation = dilation});
}

std::shared_ptr<const ReconstructedSurface> KnownSurfaces::of(const SurfaceMesh& mesh,
                                                              SurfaceShape shape) {
  const auto found = find(mesh, shape);
  Known& known = found != known_.end() ? found->second : add({.surface = made(mesh, shape)});
  known.is_asked_for = true;
  return known.surface;
}

void KnownSurfaces::scale(SurfaceMesh& mesh, SurfaceShape shape, const Dilation& dilation) {
  const auto found = find(mesh, shape);
  const bool is_fitted = found != known_.end() && found->second.unscaled == nullptr;
  mesh =
      add_scaled(is_fitted ? found->second.surface : made(mesh, shape), dilation).surface->mesh();
}

void KnownSurfaces::save(const SurfaceMesh& mesh, Archive& archive, const std::string& path) const {
  const auto [first, last] = known_.equal_range(hash_of(mesh.x));
  for (const auto& [key, known] : std::ranges::subrange(first, last)) {
    if (known.unscaled == nullptr || known.surface->mesh() != mesh) continue;
    const Vec3& center = known.dilation.center;
    archive.reals[path + "/x"] = flat(known.unscaled->mesh().x);
    archive.reals[path + "/dilation"] = {center.x(), center.y(), center.z(), known.dilation.factor};
    archive.integers[path + "/shape"] = {static_cast<std::int64_t>(known.surface->shape())};
  }
}

void KnownSurfaces::load(const SurfaceMesh& mesh, const Archive& archive, const std::string& path) {
  if (!archive.reals.contains(path + "/x")) return;
  SurfaceMesh unscaled = mesh;
  unscaled.x = vectors<VertexId>(
      entry_of_size(archive.reals, path + "/x", 3 * static_cast<std::size_t>(mesh.num_vertices())));
  const auto& dilation = entry_of_size(archive.reals, path + "/dilation", 4);
  const std::int64_t shape = entry_of_size(archive.integers, path + "/shape", 1)[0];
  if (shape != static_cast<std::int64_t>(SurfaceShape::patched) &&
      shape != static_cast<std::int64_t>(SurfaceShape::splined))
    reject_input("checkpoint: {}/shape = {} is no curved one", path, shape);
  const Dilation to{Vec3(dilation.data()), dilation[3]};
  if (scaled(unscaled, to) != mesh) reject_input("checkpoint: {} does not fit the interface", path);
  add_scaled(made(unscaled, static_cast<SurfaceShape>(shape)), to);
}

void KnownSurfaces::forget_unasked() {
  for (auto at = known_.begin(); at != known_.end();)
    at = std::exchange(at->second.is_asked_for, false) ? std::next(at) : known_.erase(at);
}

}  // namespace meniscus
