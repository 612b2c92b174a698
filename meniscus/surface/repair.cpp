#include "meniscus/surface/repair.hpp"

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/surface/restore_volume.hpp"

namespace meniscus {

std::optional<Repaired> repaired(const SurfaceMesh& mesh, const SurfaceFields& fields,
                                 SurfaceMesh shape, double volume) {
  SurfaceMesh restored = shape;
  if (volume > 0.0) restore_volume(restored, volume);
  if (!find_defect(restored).empty()) return std::nullopt;
  auto [carried, excess] = replaced_fields(fields, mesh, shape, restored);
  return Repaired{{std::move(restored), std::move(carried)}, excess};
}

std::optional<RemeshReport> repair_and_remesh(SurfaceMesh& mesh, SurfaceFields& fields,
                                              SurfaceMesh shape, double volume,
                                              const RemeshOptions& options) {
  std::optional<Repaired> next = repaired(mesh, fields, std::move(shape), volume);
  if (!next) return std::nullopt;
  RemeshReport report = remesh(next->surface.mesh, options, next->surface.fields);
  if (!report.ok) return std::nullopt;
  widen(report.field_excess, next->excess);
  mesh = std::move(next->surface.mesh);
  fields = std::move(next->surface.fields);
  return report;
}

}  // namespace meniscus
