#include "meniscus/surface/repair/replacement.hpp"

#include <algorithm>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/restore_volume.hpp"

namespace meniscus {
namespace {

std::optional<Replacement> replacement_by(const Remedy& remedy, const SurfaceMesh& mesh,
                                          const SurfaceFields& fields, SurfaceMesh shape) {
  if (!remedy.keeps_shape) return sound_replacement(mesh, fields, shape, remedy.volume);
  auto [carried, excess] = replaced_fields(fields, mesh, shape);
  return Replacement{{std::move(shape), std::move(carried)}, excess};
}

}  // namespace

std::optional<Replacement> sound_replacement(const SurfaceMesh& mesh, const SurfaceFields& fields,
                                             const SurfaceMesh& shape, double volume) {
  MENISCUS_ASSERT(volume >= 0.0, "volume = {}", volume);
  SurfaceMesh restored = shape;
  if (volume > 0.0) restore_volume(restored, volume);
  if (find_defect(restored)) return std::nullopt;
  auto [carried, excess] = replaced_fields(fields, mesh, shape, restored);
  return Replacement{{std::move(restored), std::move(carried)}, excess};
}

std::optional<MendReport> apply_first(SurfaceMesh& mesh, SurfaceFields& fields,
                                      std::span<const Remedy> remedies,
                                      const RemeshOptions& options) {
  MENISCUS_ASSERT(std::ranges::all_of(remedies, [](const Remedy& r) { return bool(r.shape); }));
  const int euler = euler_characteristic(mesh);
  for (const Remedy& remedy : remedies) {
    std::optional<SurfaceMesh> shape = remedy.shape();
    if (!shape) continue;
    std::optional<Replacement> next = replacement_by(remedy, mesh, fields, *std::move(shape));
    if (!next) continue;
    const int closed_holes = (euler_characteristic(next->surface.mesh) - euler) / 2;
    if (closed_holes < 0) continue;
    RemeshReport report = remesh(next->surface.mesh, options, next->surface.fields);
    if (!report.ok()) continue;
    follow(report.field_excess, next->excess);
    mesh = std::move(next->surface.mesh);
    fields = std::move(next->surface.fields);
    return MendReport{std::move(report), true, closed_holes, remedy.smoothed_over};
  }
  return std::nullopt;
}

}  // namespace meniscus
