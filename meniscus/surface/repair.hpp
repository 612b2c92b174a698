#pragma once

#include <optional>

#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {

/// A surface with the shape that a repair gave it, at the volume asked for [R0³] (0: that of the
/// shape), with the fields of the surface it stands for. None where it is unsound (`find_defect`).
struct Repaired {
  CarryingSurface surface;
  FieldExcess excess;
};
[[nodiscard]] std::optional<Repaired> repaired(const SurfaceMesh& mesh, const SurfaceFields& fields,
                                               SurfaceMesh shape, double volume);

/// What every ladder of repairs does with each of its shapes: `mesh` and `fields` become the
/// repaired surface as remeshed. None, and they stay, where it is unsound or cannot be remeshed.
[[nodiscard]] std::optional<RemeshReport> repair_and_remesh(SurfaceMesh& mesh,
                                                            SurfaceFields& fields,
                                                            SurfaceMesh shape, double volume,
                                                            const RemeshOptions& options);

}  // namespace meniscus
